// An input, output or parameter of the element that is chosen: what is written, to be changed, and
// its value, to be set and plotted.
import type { Core } from "../core/core";
import type { Value } from "../core/protocol";
import { button, h, say } from "../page/dom";
import { valueMenu } from "../page/values";
import { t } from "../text/language";
import type { Edits } from "./edits";
import { field } from "../page/field";
import type { Parameter, Pin } from "./protocol";
import { short } from "./shape";
import type { Item } from "./sheets";
import { real, Slider } from "./slider";

export type Named = Pin | Parameter;

/** What all rows have in common. */
export interface Table {
  core: Core;
  edits: Edits;
  item: Item;
  /** The list of what inputs can be connected to. */
  offered: string;
  plot: (operand: string) => void;
}

export class Row {
  readonly element: HTMLElement;
  private value = h("button", { attributes: { type: "button" }, class: "value" });
  private plot: HTMLButtonElement;
  private keep = button("diagramKeep", () => this.keepValue(), { class: "small" });
  private slider: Slider | null;
  private known: Value | undefined;

  /** `isFree`: nothing in the diagram gives it a value. */
  constructor(
    private table: Table,
    readonly named: Named,
    isFree: boolean,
  ) {
    const isOutput = table.item.element.outputs.includes(named as Pin);
    this.plot = button("diagramPlot", () => this.known && table.plot(this.known.name), {
      class: "small",
    });
    this.value.addEventListener("click", () => {
      if (this.known) valueMenu(table.core, this.known, this.value);
    });
    this.slider = isFree ? this.makeSlider() : null;
    const given = isOutput ? h("code", {}, this.written) : this.field();
    const comment = "comment" in named ? named.comment : "";
    this.element = h(
      "tr",
      {},
      h("th", { attributes: { scope: "row", title: comment || undefined } }, named.name || ":="),
      h("td", { class: "type" }, named.type),
      h("td", { class: "written" }, given, this.slider?.element),
      h("td", {}, this.value, this.plot, this.keep),
    );
    this.show(undefined);
  }

  /** As in the text; of a parameter its declared value. */
  private get written(): string {
    return ("value" in this.named ? this.named.value : this.named.written) ?? "";
  }

  private field(): HTMLElement {
    const { name } = this.named;
    const list = this.table.offered;
    const input = field(name, this.written, (value) => this.write(value), { list });
    say(input, "aria-label", "diagramValueOf", name || this.table.item.element.fullName);
    return input;
  }

  private write(value: string): Promise<boolean> {
    const { edits, item } = this.table;
    const { name } = this.named;
    return "value" in this.named ? edits.set(item, name, value) : edits.give(item, name, value);
  }

  /** Of a number, around the value that it begins with. */
  private makeSlider(): Slider | null {
    const { name, type } = this.named;
    const declared = Number("value" in this.named ? (this.named.value ?? 0) : 0);
    if (type.toUpperCase() !== "REAL" || Number.isNaN(declared)) return null;
    return new Slider(name, declared, (value) => {
      const operand = this.known?.name;
      if (operand) this.table.core.tell({ do: "set", operand, value });
    });
  }

  /** What a slider has found becomes what is declared. */
  private keepValue(): void {
    if (this.known?.number != null) void this.write(real(short(this.known)));
  }

  show(value: Value | undefined): void {
    this.known = value;
    const text = value ? short(value) : "";
    if (this.value.textContent !== text) this.value.textContent = text;
    this.value.hidden = this.plot.hidden = !value;
    if (value) this.value.setAttribute("aria-label", `${value.name} = ${text}`);
    this.value.classList.toggle("is-forced", value?.forced === true);
    this.plot.setAttribute("aria-label", value ? t("diagramPlotOf", value.name) : "");
    this.slider?.show(value?.number ?? null);
    const isTuned = value?.number != null && Number(text) !== Number(this.written || 0);
    this.keep.hidden = !(this.slider && "value" in this.named && isTuned);
    this.keep.setAttribute("aria-label", value ? t("diagramKeepOf", value.name) : "");
  }
}

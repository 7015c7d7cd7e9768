// What there is to be read and changed of the element that is chosen: its inputs, outputs and
// parameters, with what is written and with their values.
import type { Core } from "../core/core";
import type { Value } from "../core/protocol";
import { button, h, newId, say } from "../page/dom";
import { valueMenu } from "../page/values";
import { t } from "../text/language";
import { nameOf, type Edits } from "./edits";
import type { Live } from "./live";
import type { Parameter, Pin } from "./protocol";
import { short } from "./shape";
import type { Item } from "./sheets";
import { Slider } from "./slider";

type Named = Pin | Parameter;

/** What every call can have. */
const ENABLE: Pin = { name: "EN", type: "BOOL", at: [0, 0], text: "", written: null, names: [] };

interface Row {
  named: Named;
  value: HTMLButtonElement;
  plot: HTMLButtonElement;
  slider: Slider | null;
  known: Value | undefined;
}

export class Details {
  readonly element = h("section", { class: "block-details", label: "diagramDetails" });
  private outputs = h("datalist", { attributes: { id: newId() } });
  private offered = "";
  private rows: Row[] = [];
  private shown: Item | null = null;

  constructor(
    private core: Core,
    private live: Live,
    private edits: Edits,
    private plot: (operand: string) => void,
    private goTo: (line: number) => void,
  ) {
    this.show(null);
  }

  /** What it shows the values of. */
  get named(): Named[] {
    return this.rows.map(({ named }) => named);
  }

  show(item: Item | null): void {
    const isSame = JSON.stringify(item) === JSON.stringify(this.shown);
    if (isSame && item) return this.showValues();
    this.shown = item;
    this.rows = [];
    this.element.hidden = item === null;
    if (!item) return this.element.replaceChildren();
    const { element, linked } = item;
    const isLinked = (pin: Pin) => linked.includes(element.inputs.indexOf(pin));
    const free = element.inputs.filter((pin) => isFree(pin) && !isLinked(pin));
    const { fullName, block, line, comment } = element;
    const title = h("h2", {}, block === null ? fullName : `${fullName}: ${block}`);
    const go = button("showPlace", () => this.goTo(line), { class: "small" });
    const isCall = block !== null;
    const hasEnable = element.inputs.some(({ name }) => name.toUpperCase() === "EN");
    const inputs = isCall && !hasEnable ? [ENABLE, ...element.inputs] : element.inputs;
    const parts = [
      this.part("diagramInputs", inputs, free),
      this.part("diagramOutputs", element.outputs),
      this.part("diagramParameters", element.parameters, element.parameters),
    ];
    const { activeElement } = document;
    const of = this.element.contains(activeElement)
      ? (activeElement as HTMLElement).dataset["of"]
      : undefined;
    this.element.replaceChildren(
      this.outputs,
      h("div", { class: "controls" }, title, go),
      comment === "" ? "" : h("p", { class: "hint" }, comment),
      h("div", { class: "scroll" }, h("table", {}, ...parts.filter((part) => part !== null))),
    );
    this.showValues();
    const fields = [...this.element.querySelectorAll<HTMLElement>("[data-of]")];
    if (of !== undefined) fields.find((field) => field.dataset["of"] === of)?.focus();
  }

  /** What inputs can be connected to. */
  offer(items: Item[]): void {
    const names = items.flatMap((item) => item.element.outputs.map((_, at) => nameOf(item, at)));
    if (names.join() === this.offered) return;
    this.offered = names.join();
    this.outputs.replaceChildren(...names.map((name) => h("option", { set: { value: name } })));
  }

  private part(
    text: "diagramInputs" | "diagramOutputs" | "diagramParameters",
    named: Named[],
    free: Named[] = [],
  ): HTMLElement | null {
    if (named.length === 0) return null;
    const head = h("th", { text, attributes: { scope: "rowgroup", colspan: 4 } });
    return h(
      "tbody",
      {},
      h("tr", {}, head),
      ...named.map((one) => this.row(one, free.includes(one))),
    );
  }

  private row(named: Named, isFree: boolean): HTMLElement {
    const isParameter = "value" in named;
    const written = isParameter ? named.value : named.written;
    const value = h("button", { attributes: { type: "button" }, class: "value" });
    const plot = button("diagramPlot", () => row.known && this.plot(row.known.name), {
      class: "small",
    });
    const row: Row = { named, value, plot, slider: null, known: undefined };
    if (isFree) row.slider = this.slider(row, isParameter ? written : null);
    value.addEventListener("click", () => row.known && valueMenu(this.core, row.known, value));
    this.rows.push(row);
    const comment = isParameter ? named.comment : "";
    const isOutput = this.shown?.element.outputs.includes(named as Pin) ?? false;
    const given = isOutput ? h("code", {}, written ?? "") : this.field(named, written ?? "");
    return h(
      "tr",
      {},
      h("th", { attributes: { scope: "row", title: comment || undefined } }, named.name || ":="),
      h("td", { class: "type" }, named.type),
      h("td", { class: "written" }, given, row.slider?.element),
      h("td", {}, value, plot),
    );
  }

  /** What is given to an input, or declared of a parameter, to be written. */
  private field(named: Named, written: string): HTMLElement {
    const { name } = named;
    const field = h("input", {
      attributes: { list: this.outputs.id, autocomplete: "off", spellcheck: "false" },
      set: { value: written },
    });
    field.dataset["of"] = name;
    say(field, "aria-label", "diagramValueOf", name || (this.shown?.element.fullName ?? ""));
    field.addEventListener("keydown", (event) => {
      if (event.key === "Escape") field.value = written;
    });
    field.addEventListener("change", () => {
      const item = this.shown;
      const value = field.value.trim();
      if (!item || value === written) return;
      const done =
        "value" in named ? this.edits.set(item, name, value) : this.edits.give(item, name, value);
      void done.then((isDone) => {
        if (!isDone) field.value = written;
      });
    });
    return field;
  }

  /** Of a number, around the value that it begins with. */
  private slider(row: Row, begin: string | null): Slider | null {
    const { name, type } = row.named;
    const declared = Number(begin ?? 0);
    if (type.toUpperCase() !== "REAL" || Number.isNaN(declared)) return null;
    return new Slider(name, declared, (value) => {
      const operand = row.known?.name;
      if (operand) this.core.tell({ do: "set", operand, value });
    });
  }

  showValues(): void {
    const values = this.live.of(this.named);
    for (const [at, row] of this.rows.entries()) {
      const value = values[at];
      row.known = value;
      const text = value ? short(value) : "";
      if (row.value.textContent !== text) row.value.textContent = text;
      row.value.hidden = row.plot.hidden = !value;
      if (value) row.value.setAttribute("aria-label", `${value.name} = ${text}`);
      row.value.classList.toggle("is-forced", value?.forced === true);
      row.plot.setAttribute("aria-label", value ? t("diagramPlotOf", value.name) : "");
      row.slider?.show(value?.number ?? null);
    }
  }
}

/** Whether somebody else than the diagram gives an input its value. */
function isFree({ names, written }: Pin): boolean {
  const name = written?.replace(/^%/, "").toLowerCase();
  return name === undefined || names.some((one) => one.toLowerCase() === name);
}

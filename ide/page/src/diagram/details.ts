// What there is to be read and changed of the element that is chosen: its inputs, outputs and
// parameters.
import type { Core } from "../core/core";
import { button, h, newId, say } from "../page/dom";
import { field } from "../page/field";
import { nameOf, type Edits } from "./edits";
import type { Live } from "./live";
import type { Pin } from "./protocol";
import { Row, type Named, type Table } from "./row";
import type { Item } from "./sheets";

/** What every call can have. */
const ENABLE: Pin = { name: "EN", type: "BOOL", at: [0, 0], text: "", written: null, names: [] };

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
    const focus = this.focused();
    this.shown = item;
    this.rows = [];
    this.element.hidden = item === null;
    this.element.replaceChildren(...(item ? this.parts(item) : []));
    this.showValues();
    const fields = [...this.element.querySelectorAll<HTMLElement>("[data-of]")];
    if (focus !== undefined) fields.find((field) => field.dataset["of"] === focus)?.focus();
  }

  /** The name beside the field that has the focus. */
  private focused(): string | undefined {
    const { activeElement } = document;
    const isHere = activeElement instanceof HTMLElement && this.element.contains(activeElement);
    return isHere ? activeElement.dataset["of"] : undefined;
  }

  private parts(item: Item): HTMLElement[] {
    const { element, linked } = item;
    const { fullName, block, line, comment, inputs, outputs, parameters } = element;
    const { core, edits, plot } = this;
    const table = { core, edits, item, offered: this.outputs.id, plot };
    const free = inputs.filter((pin, at) => isFree(pin) && !linked.includes(at));
    const hasEnable = block === null || inputs.some(({ name }) => name.toUpperCase() === "EN");
    const title = h("h2", {}, block === null ? fullName : `${fullName}: ${block}`);
    const said = field("//", comment, (words) => edits.comment(item, words), { class: "comment" });
    say(said, "aria-label", "diagramComment");
    say(said, "placeholder", "diagramComment");
    const go = button("showPlace", () => this.goTo(line), { class: "small" });
    const bodies = [
      this.part(table, "diagramInputs", hasEnable ? inputs : [ENABLE, ...inputs], free),
      this.part(table, "diagramOutputs", outputs, []),
      this.part(table, "diagramParameters", parameters, parameters),
    ];
    return [
      this.outputs,
      h("div", { class: "controls" }, title, go, said),
      h("div", { class: "scroll" }, h("table", {}, ...bodies)),
    ];
  }

  private part(
    table: Table,
    text: "diagramInputs" | "diagramOutputs" | "diagramParameters",
    named: Named[],
    free: Named[],
  ): HTMLElement | null {
    if (named.length === 0) return null;
    const rows = named.map((one) => new Row(table, one, free.includes(one)));
    this.rows.push(...rows);
    const head = h("th", { text, attributes: { scope: "rowgroup", colspan: 4 } });
    return h("tbody", {}, h("tr", {}, head), ...rows.map(({ element }) => element));
  }

  /** What inputs can be connected to. */
  offer(items: Item[]): void {
    const names = items.flatMap((item) => item.element.outputs.map((_, at) => nameOf(item, at)));
    if (names.join() === this.offered) return;
    this.offered = names.join();
    this.outputs.replaceChildren(...names.map((name) => h("option", { set: { value: name } })));
  }

  showValues(): void {
    const values = this.live.of(this.named);
    for (const [at, row] of this.rows.entries()) row.show(values[at]);
  }
}

/** Whether somebody else than the diagram gives an input its value. */
function isFree({ names, written }: Pin): boolean {
  const name = written?.replace(/^%/, "").toLowerCase();
  return name === undefined || names.some((one) => one.toLowerCase() === name);
}

// The table of the two cursors: values at both, and what is between them.
import { h, say } from "../page/dom";
import { t } from "../text/language";
import type { CursorName, Plots } from "./plots";

export class CursorTable {
  readonly element: HTMLElement;
  /** Is told when a cursor, or what it is in, is another one. */
  changed: () => void = () => {};
  private fields: Record<CursorName, HTMLInputElement>;
  private difference = h("td");
  private body = h("tbody");
  private rows = new Map<string, HTMLTableCellElement[]>();

  constructor(private plots: Plots) {
    this.fields = { A: this.field("A"), B: this.field("B") };
    const heads = ["A", "B", "B − A"].map((name) =>
      h("th", { attributes: { scope: "col" } }, name),
    );
    const times = h(
      "tr",
      {},
      h("th", { text: "timeSeconds", attributes: { scope: "row" } }),
      h("td", {}, this.fields.A),
      h("td", {}, this.fields.B),
      this.difference,
    );
    this.element = h(
      "details",
      { class: "cursors" },
      h("summary", { text: "cursors" }),
      h("p", { class: "hint", text: "cursorsHint" }),
      h(
        "table",
        {},
        h(
          "thead",
          {},
          h("tr", {}, h("th", { text: "signal", attributes: { scope: "col" } }), ...heads),
        ),
        h("tbody", {}, times),
        this.body,
      ),
    );
    plots.cursorMoved = () => this.show();
  }

  private field(name: CursorName): HTMLInputElement {
    const field = h("input", { attributes: { type: "number", step: "any" } });
    say(field, "aria-label", "cursorTime", name);
    field.addEventListener("input", () => {
      this.plots.cursors[name] = field.value === "" ? null : Number(field.value) * 1000;
      this.plots.redraw();
      this.update();
    });
    return field;
  }

  /** The cursors were moved in the plots. */
  private show(): void {
    if (this.element instanceof HTMLDetailsElement) this.element.open = true;
    for (const name of ["A", "B"] as const) {
      const time = this.plots.cursors[name];
      this.fields[name].value = time === null ? "" : (time / 1000).toFixed(3);
    }
    this.update();
  }

  /** The signals are these; their values may be other ones. */
  update(names?: string[]): void {
    if (names && names.join("\n") !== [...this.rows.keys()].join("\n")) this.setNames(names);
    const { A, B } = this.plots.cursors;
    const isBoth = A !== null && B !== null;
    this.difference.textContent = isBoth ? t("seconds", ((B - A) / 1000).toFixed(3)) : "";
    const before = A === null ? [] : this.plots.valuesAt(A);
    const after = B === null ? [] : this.plots.valuesAt(B);
    for (const [index, cells] of [...this.rows.values()].entries()) {
      const [a, b] = [before[index] ?? null, after[index] ?? null];
      const shown = [a, b, a !== null && b !== null ? b - a : null];
      for (const [at, cell] of cells.entries()) cell.textContent = words(shown[at] ?? null);
    }
    this.changed();
  }

  private setNames(names: string[]): void {
    this.rows = new Map(names.map((name) => [name, [h("td"), h("td"), h("td")]]));
    const rows = [...this.rows].map(([name, cells]) =>
      h("tr", {}, h("th", { attributes: { scope: "row" } }, name), ...cells),
    );
    this.body.replaceChildren(...rows);
  }
}

function words(value: number | null): string {
  return value === null ? "" : String(Number(value.toPrecision(7)));
}

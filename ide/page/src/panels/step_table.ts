// The figures of a step response as a table: of which signal, with which set value.
import { h } from "../page/dom";
import type { Cursors, Data } from "../plot/plots";
import { stepResponse, type Response } from "../plot/step";
import { addWords, onLanguage, t, type Key } from "../text/language";
import { STEP_WORDS } from "../text/step_words";
import { rounded } from "./numbers";
import { labelled } from "./scope";

addWords(STEP_WORDS);

/** What is plotted. */
export interface Plotted extends Data {
  names: string[];
}

type Figure = Exclude<keyof Response, "kind" | "missing">;
const ROWS: Record<Figure, { text: Key; unit?: string }> = {
  begin: { text: "stepBegin", unit: "s" },
  before: { text: "stepBefore" },
  after: { text: "stepAfter" },
  rise: { text: "stepRise", unit: "s" },
  overshoot: { text: "stepOvershoot", unit: "%" },
  settling: { text: "stepSettling", unit: "s" },
  steadyError: { text: "stepError" },
  iae: { text: "stepIae" },
};
const FIGURES = Object.keys(ROWS) as Figure[];

const DECIMALS = 6;

/** Choices of the set value that are no signals; no signal has such a name. */
const NONE = "";
const NUMBER = "=";

export class StepTable {
  private signal = h("select", { on: { change: () => this.show() } }) as HTMLSelectElement;
  private wanted = h("select", { on: { change: () => this.show() } }) as HTMLSelectElement;
  private number = h("input", {
    attributes: { type: "number", step: "any" },
    set: { value: "1" },
    on: { input: () => this.show() },
  }) as HTMLInputElement;
  private numberPart = labelled("stepValue", this.number);
  private cells = new Map(FIGURES.map((figure) => [figure, h("td")]));
  private state = h("p", { class: "hint", attributes: { "aria-live": "polite" } });
  private gaps = h("p", { class: "hint bad" });
  private names = "";

  constructor(
    element: HTMLElement,
    private plotted: () => Plotted | undefined,
    private cursors: Cursors,
  ) {
    const controls = [
      labelled("stepSignal", this.signal),
      labelled("stepWanted", this.wanted),
      this.numberPart,
    ];
    element.append(
      h("p", { class: "hint", text: "stepHint" }),
      h("div", { class: "controls" }, ...controls),
      this.state,
      this.gaps,
      this.table(),
    );
    onLanguage(() => this.show());
  }

  /** Computes nothing while it cannot be seen. */
  shown(isShown: boolean): void {
    if (isShown) this.show();
  }

  private table(): HTMLElement {
    const rows = FIGURES.map((figure) => {
      const head = h("th", { text: ROWS[figure].text, attributes: { scope: "row" } });
      return h("tr", {}, head, this.cells.get(figure));
    });
    return h("table", { class: "figures", label: "stepResponse" }, h("tbody", {}, ...rows));
  }

  private show(): void {
    const plotted = this.plotted();
    if (!plotted) return;
    this.fill(plotted.names);
    this.numberPart.hidden = this.wanted.value !== NUMBER;
    const { times } = plotted;
    const column = (name: string) => plotted.columns[plotted.names.indexOf(name)];
    const response = stepResponse(
      {
        times,
        signal: column(this.signal.value) ?? [],
        wanted:
          this.wanted.value === NUMBER ? this.wantedNumber() : (column(this.wanted.value) ?? null),
      },
      this.range(times),
    );
    for (const [figure, cell] of this.cells)
      cell.textContent = words(response[figure], ROWS[figure].unit);
    const { kind } = response;
    this.state.textContent = kind === "step" ? "" : t(`step-${kind}`);
    this.gaps.textContent = t("stepMissing", rounded(response.missing, DECIMALS));
    this.gaps.hidden = response.missing === 0;
  }

  /** A field that is empty is no number. */
  private wantedNumber(): number | null {
    return Number.isNaN(this.number.valueAsNumber) ? null : this.number.valueAsNumber;
  }

  private range(times: number[]): [number, number] {
    const { A, B } = this.cursors;
    if (A !== null && B !== null) return [Math.min(A, B), Math.max(A, B)];
    return [times[0] ?? 0, times.at(-1) ?? 0];
  }

  /** The signals are these; what was chosen stays chosen if it is one of them. */
  private fill(names: string[]): void {
    if (names.join("\n") === this.names) return;
    this.names = names.join("\n");
    const options = () => names.map((name) => h("option", { set: { value: name } }, name));
    const [signal, wanted] = [this.signal.value, this.wanted.value];
    this.signal.replaceChildren(...options());
    this.wanted.replaceChildren(
      h("option", { text: "stepNone", set: { value: NONE } }),
      h("option", { text: "stepNumber", set: { value: NUMBER } }),
      ...options(),
    );
    this.signal.value = names.includes(signal) ? signal : (names[0] ?? "");
    this.wanted.value = [NUMBER, ...names].includes(wanted) ? wanted : NONE;
  }
}

/** What is not known is a dash. */
function words(figure: number | null, unit: string | undefined): string {
  if (figure === null) return "–";
  return unit ? `${rounded(figure, DECIMALS)} ${unit}` : String(rounded(figure, DECIMALS));
}

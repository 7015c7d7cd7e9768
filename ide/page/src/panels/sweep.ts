// A frequency response: what is excited, from where to where, which frequencies; then the plot and its
// figures. The core measures.
import { Refusal, type Core } from "../core/core";
import type { FrequencyResponse } from "../core/protocol";
import { button, h, say } from "../page/dom";
import { notice } from "../page/notices";
import { Bode } from "../plot/bode";
import { save } from "../project/files";
import type { Project } from "../project/project";
import { addWords, onLanguage, t } from "../text/language";
import { SWEEP_WORDS } from "../text/sweep_words";
import { numberField, rounded } from "./numbers";
import type { Operands } from "./operands";
import { labelled } from "./scope";

addWords(SWEEP_WORDS);

/** More of what comes out than this is worth a word. */
const DISTORTION_MAX = 0.05;
const FIGURES = {
  bandwidth: "sweepBandwidth",
  phaseMargin: "sweepPhaseMargin",
  gainMargin: "sweepGainMargin",
} as const;

export class Sweep {
  private excite: HTMLInputElement;
  private from: HTMLInputElement;
  private to: HTMLInputElement;
  private low = numberField(0.1, { min: 0, step: "any" });
  private high = numberField(10, { min: 0, step: "any" });
  private amplitude = numberField(1, { min: 0, step: "any" });
  private offset = numberField(0, { step: "any" });
  private measure = h("button", {
    text: "sweepMeasure",
    class: "primary",
    attributes: { type: "submit" },
  }) as HTMLButtonElement;
  private words = h("p", { class: "hint", attributes: { "aria-live": "polite" } });
  private warnings = h("p", { class: "hint bad" });
  private point = h("p", { class: "hint" });
  private bode = new Bode((index) => this.showPoint(index));
  private cells = {
    bandwidth: h("td"),
    phaseMargin: h("td"),
    gainMargin: h("td"),
  };
  private result = h("div", { class: "result", attributes: { hidden: true } });
  private response: FrequencyResponse | undefined;

  constructor(
    element: HTMLElement,
    private core: Core,
    private project: Project,
    operands: Operands,
    /** The step in milliseconds; null where it is not valid, which is shown. */
    private stepMs: () => number | null,
  ) {
    this.excite = operands.field();
    this.from = operands.field(undefined, false);
    this.to = operands.field();
    const submit = (event: Event) => {
      event.preventDefault();
      void this.run();
    };
    const controls = h(
      "form",
      { class: "controls", on: { submit } },
      labelled("sweepExcite", this.excite),
      labelled("sweepFrom", this.from),
      labelled("sweepTo", this.to),
      labelled("sweepLow", this.low),
      labelled("sweepHigh", this.high),
      labelled("sweepAmplitude", this.amplitude),
      labelled("sweepOffset", this.offset),
      this.measure,
    );
    const saving = button("saveCsv", () => this.save());
    this.result.append(
      this.warnings,
      h("div", { class: "controls" }, saving),
      this.bode.element,
      this.point,
      this.table(),
    );
    element.append(h("p", { class: "hint", text: "sweepHint" }), controls, this.words, this.result);
    onLanguage(() => this.show());
  }

  /** Draws nothing while it cannot be seen: it would have no width. */
  shown(isShown: boolean): void {
    if (isShown) this.show();
  }

  private table(): HTMLElement {
    const rows = Object.entries(this.cells).map(([figure, cell]) => {
      const text = FIGURES[figure as keyof typeof FIGURES];
      return h("tr", {}, h("th", { text, attributes: { scope: "row" } }), cell);
    });
    return h("table", { class: "figures", label: "frequencyResponse" }, h("tbody", {}, ...rows));
  }

  private async run(): Promise<void> {
    const scanMs = this.stepMs();
    if (scanMs === null) return;
    this.measure.disabled = true;
    say(this.words, "text", "sweeping");
    try {
      const path = {
        excite: this.excite.value.trim(),
        from: this.from.value.trim() || null,
        to: this.to.value.trim(),
        low: this.low.valueAsNumber,
        high: this.high.valueAsNumber,
        amplitude: this.amplitude.valueAsNumber,
        offset: this.offset.valueAsNumber,
      };
      const plant = this.project.plant;
      this.response = await this.core.ask({ do: "sweep", path, scanMs, plant });
      this.show();
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      notice(error.message, true);
    } finally {
      this.words.textContent = "";
      this.measure.disabled = false;
    }
  }

  private show(): void {
    const { response } = this;
    this.result.hidden = !response;
    if (!response) return;
    this.bode.draw(response);
    this.showPoint(null);
    const { bandwidth, phaseMargin, gainMargin } = response.figures;
    const at = (margin: [number, number] | null, unit: string) =>
      margin ? t("sweepAt", `${rounded(margin[1])}${unit}`, rounded(margin[0])) : "–";
    this.cells.bandwidth.textContent = bandwidth === null ? "–" : `${rounded(bandwidth)} Hz`;
    this.cells.phaseMargin.textContent = at(phaseMargin, "°");
    this.cells.gainMargin.textContent = at(gainMargin, " dB");
    this.warnings.textContent = warnings(response).join(" ");
  }

  private showPoint(index: number | null): void {
    const { response } = this;
    if (!response || index === null) {
      // The line stays, so that nothing jumps.
      this.point.textContent = "\u00a0";
      return;
    }
    const [gain, phase] = [response.gains[index], response.phases[index]].map((value) =>
      value === null || value === undefined ? "–" : rounded(value),
    );
    const hertz = rounded(response.frequencies[index] ?? 0);
    const distortion = rounded((response.distortions[index] ?? 0) * 100);
    this.point.textContent = t("sweepPoint", hertz, gain ?? "–", phase ?? "–", distortion);
  }

  private save(): void {
    const name = `${this.project.stem("sweep")}_sweep.csv`;
    if (this.response) save(name, this.response.csv, "text/csv");
  }
}

/** What to be careful with. */
function warnings(response: FrequencyResponse): string[] {
  const words = [];
  const unsettled = response.frequencies.filter((_, index) => !response.settled[index]);
  const places = unsettled.map((hertz) => rounded(hertz)).join(", ");
  if (unsettled.length > 0) words.push(t("sweepUnsettled", places));
  const most = Math.max(0, ...response.distortions);
  if (most > DISTORTION_MAX) words.push(t("sweepDistorted", Math.round(most * 100)));
  return words;
}

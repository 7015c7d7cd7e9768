// Capture: what the target does is recorded for a time, or the program is run apart from it, as fast
// as possible. Both are plotted, and saved.
import { Refusal, type Core } from "../core/core";
import type { Recording } from "../core/protocol";
import { button, h, say } from "../page/dom";
import { notice } from "../page/notices";
import { CursorTable } from "../plot/cursors";
import { Plots } from "../plot/plots";
import type { Chosen } from "../project/chosen";
import { save } from "../project/files";
import type { Project } from "../project/project";
import { t, type Key } from "../text/language";
import { Lazy } from "./lazy";
import { numberField } from "./numbers";
import type { Operands } from "./operands";
import { labelled } from "./scope";
import { Signals } from "./signals";

/** A run that is longer takes too long for a page. */
const SECONDS_MAX = 24 * 3600;
const STEP_MS_MAX = 1000;

export class Capture {
  readonly element: HTMLElement;
  private signals: Signals;
  private plots = new Plots();
  private cursors = new CursorTable(this.plots);
  private seconds = numberField(60, { min: 0.001, max: SECONDS_MAX, step: 0.001 });
  private stepMs = numberField(1, { min: 1, max: STEP_MS_MAX, step: 1 });
  private simulate: HTMLButtonElement;
  private record: HTMLButtonElement;
  private recordWords: Element;
  private isRecording = false;
  private result = h("div", { class: "result", attributes: { hidden: true } });
  private figures = h("tbody");
  private step = new Lazy("step", async (element) => {
    const { StepTable } = await import("./step_table");
    return new StepTable(element, () => this.recording, this.plots.cursors);
  });
  private sweep = new Lazy("sweep", async (element) => {
    const { Sweep } = await import("./sweep");
    const stepMs = () => (this.stepMs.reportValidity() ? Number(this.stepMs.value) : null);
    return new Sweep(element, this.core, this.project, this.operands, stepMs);
  });
  private words = h("p", { class: "hint", attributes: { "aria-live": "polite" } });
  private recording: Recording | undefined;
  private isShown = false;

  constructor(
    private core: Core,
    private project: Project,
    private operands: Operands,
    chosen: Chosen,
  ) {
    this.signals = new Signals(operands, chosen, "capture", () => {});
    this.simulate = button("simulate", () => void this.run(), { class: "primary" });
    this.record = button("record", () => this.startOrEnd());
    this.recordWords = this.record.querySelector(".words")!;
    say(this.stepMs, "title", "stepMsHint");
    const controls = h(
      "div",
      { class: "controls" },
      labelled("forSeconds", this.seconds),
      labelled("stepMs", this.stepMs),
      this.simulate,
      this.record,
    );
    this.result.append(this.saveButtons(), this.plots.element, this.cursors.element, this.table());
    this.cursors.changed = this.part("stepResponse", this.step, this.result);
    this.element = h(
      "div",
      {},
      h("p", { class: "hint", text: "captureHint" }),
      this.signals.element,
      controls,
      this.words,
      this.result,
    );
    this.part("frequencyResponse", this.sweep, this.element);
    core.on("recording", ({ doneMs, gaps }) => this.showProgress(doneMs, gaps));
    core.on("recorded", ({ recording, ended }) => this.take(recording, ended));
  }

  shown(isShown: boolean): void {
    this.isShown = isShown;
    if (isShown) this.draw();
  }

  private saveButtons(): HTMLElement {
    return h(
      "div",
      { class: "controls" },
      button("saveCsv", () => this.save("csv", this.recording?.csv, "text/csv")),
      button("saveVcd", () => this.save("vcd", this.recording?.vcd, "text/plain")),
      button("savePng", () => this.savePicture()),
    );
  }

  private table(): HTMLElement {
    const heads = (["signal", "least", "greatest", "mean"] as const).map((text) =>
      h("th", { text, attributes: { scope: "col" } }),
    );
    return h("table", { class: "figures" }, h("thead", {}, h("tr", {}, ...heads)), this.figures);
  }

  /** A part that is opened; gives what it does when what it shows has changed. */
  private part(text: Key, contents: Lazy, home: HTMLElement): () => void {
    const summary = h("summary", { text });
    const part = h("details", {}, summary, contents.element) as HTMLDetailsElement;
    const show = () => contents.shown(part.open);
    part.addEventListener("toggle", show);
    home.append(part);
    return show;
  }

  /** For how long, and from step to step; null where that is not valid, which is shown. */
  private times(): { forMs: number; stepMs: number } | null {
    if (!this.seconds.reportValidity() || !this.stepMs.reportValidity()) return null;
    const forMs = Math.round(Number(this.seconds.value) * 1000);
    return { forMs, stepMs: Number(this.stepMs.value) };
  }

  private startOrEnd(): void {
    if (this.isRecording) return this.core.tell({ do: "endRecording" });
    const times = this.times();
    if (!times) return;
    this.core.beforeQuestion();
    const { forMs, stepMs: everyMs } = times;
    this.core.tell({ do: "record", signals: this.signals.names, everyMs, forMs });
  }

  private setRecording(isRecording: boolean): void {
    this.isRecording = isRecording;
    this.simulate.disabled = isRecording;
    const key = isRecording ? "endRecording" : "record";
    say(this.recordWords, "text", key);
    say(this.record, "title", key);
  }

  private showProgress(doneMs: number, gaps: number): void {
    if (!this.isRecording) this.setRecording(true);
    const done = (doneMs / 1000).toFixed(1);
    const words = [t("recordingNow", done, this.seconds.value)];
    if (gaps > 0) words.push(t("samplesLost", gaps));
    this.words.textContent = words.join(" · ");
  }

  /** What the target has done. */
  private take(recording: Recording, ended: string | null): void {
    this.setRecording(false);
    this.recording = recording;
    const seconds = ((recording.times.at(-1) ?? 0) / 1000).toLocaleString();
    const rows = recording.times.length.toLocaleString();
    const words = [t("recordedOfTarget", seconds, rows)];
    if (recording.gaps > 0) words.push(t("samplesLost", recording.gaps));
    if (ended !== null) words.push(ended);
    this.words.textContent = words.join(" · ");
    this.draw();
  }

  private async run(): Promise<void> {
    const times = this.times();
    if (!times) return;
    const { forMs, stepMs: scanMs } = times;
    this.simulate.disabled = true;
    say(this.words, "text", "simulating");
    try {
      const plant = this.project.plant;
      const signals = this.signals.names;
      this.recording = await this.core.ask({ do: "simulate", signals, forMs, scanMs, plant });
      const seconds = ((this.recording.times.at(-1) ?? 0) / 1000).toLocaleString();
      const changes = this.recording.times.length.toLocaleString();
      say(this.words, "text", "recorded", seconds, changes, this.recording.plant ?? "");
      this.draw();
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      this.words.textContent = "";
      notice(error.message, true);
    } finally {
      this.simulate.disabled = false;
    }
  }

  private draw(): void {
    const { recording } = this;
    this.result.hidden = !recording;
    if (!recording || !this.isShown) return;
    const { names, times, columns, figures } = recording;
    const range: [number, number] = [times[0] ?? 0, times.at(-1) ?? 1];
    this.plots.draw(names, { times, columns }, range);
    this.cursors.update(names);
    const rows = names.map((name, index) => {
      const numbers = figures[index] ?? [];
      const cells = numbers.map((figure) => h("td", {}, figureWords(figure)));
      return h("tr", {}, h("th", { attributes: { scope: "row" } }, name), ...cells);
    });
    this.figures.replaceChildren(...rows);
  }

  private save(ending: string, text: string | undefined, type: string): void {
    if (text !== undefined) save(`${this.project.stem("capture")}.${ending}`, text, type);
  }

  private savePicture(): void {
    this.plots.picture().toBlob((blob) => {
      if (blob) save(`${this.project.stem("capture")}.png`, blob, "image/png");
      else notice(t("noPicture"), true);
    });
  }
}

/** A figure; of what was never measured there is none. */
function figureWords(figure: number | null): string {
  return figure === null ? "–" : String(Number(figure.toPrecision(7)));
}

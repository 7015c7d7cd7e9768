// Capture: the program is run for a time, as fast as possible, and what it did is plotted.
import { Refusal, type Core } from "../core/core";
import type { Recording } from "../core/protocol";
import { button, h, say } from "../page/dom";
import { notice } from "../page/notices";
import { CursorTable } from "../plot/cursors";
import { Plots } from "../plot/plots";
import { save } from "../project/files";
import type { Project } from "../project/project";
import { t } from "../text/language";
import type { Operands } from "./operands";
import { labelled } from "./scope";
import { Signals } from "./signals";

/** A run that is longer takes too long for a page. */
const SECONDS_MAX = 24 * 3600;
const SCAN_MS_MAX = 1000;

export class Capture {
  readonly element: HTMLElement;
  private signals: Signals;
  private plots = new Plots();
  private cursors = new CursorTable(this.plots);
  private seconds = number(60, SECONDS_MAX, 0.001);
  private scanMs = number(1, SCAN_MS_MAX, 1);
  private simulate: HTMLButtonElement;
  private result = h("div", { class: "result", attributes: { hidden: true } });
  private figures = h("tbody");
  private words = h("p", { class: "hint", attributes: { "aria-live": "polite" } });
  private recording: Recording | undefined;
  private isShown = false;

  constructor(
    private core: Core,
    private project: Project,
    operands: Operands,
  ) {
    this.signals = new Signals(operands, "uno200.capture", () => {});
    this.simulate = button("simulate", () => void this.run(), { class: "primary" });
    const controls = h(
      "div",
      { class: "controls" },
      labelled("forSeconds", this.seconds),
      labelled("scanMs", this.scanMs),
      this.simulate,
    );
    this.result.append(this.saveButtons(), this.plots.element, this.cursors.element, this.table());
    this.element = h(
      "div",
      {},
      h("p", { class: "hint", text: "captureHint" }),
      this.signals.element,
      controls,
      this.words,
      this.result,
    );
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

  private async run(): Promise<void> {
    const forMs = Math.round(Number(this.seconds.value) * 1000);
    const scanMs = Number(this.scanMs.value);
    if (!this.seconds.reportValidity() || !this.scanMs.reportValidity()) return;
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
      const cells = numbers.map((figure) => h("td", {}, String(Number(figure.toPrecision(7)))));
      return h("tr", {}, h("th", { attributes: { scope: "row" } }, name), ...cells);
    });
    this.figures.replaceChildren(...rows);
  }

  private name(): string {
    return (this.project.main() ?? "capture").replace(/^.*\/|\.[^.]*$/g, "");
  }

  private save(ending: string, text: string | undefined, type: string): void {
    if (text !== undefined) save(`${this.name()}.${ending}`, text, type);
  }

  private savePicture(): void {
    this.plots.picture().toBlob((blob) => {
      if (blob) save(`${this.name()}.png`, blob, "image/png");
      else notice(t("noPicture"), true);
    });
  }
}

function number(value: number, max: number, step: number): HTMLInputElement {
  return h("input", {
    attributes: { type: "number", min: step, max, step, required: true },
    set: { value: String(value) },
  });
}

// The oscilloscope: a window of the last samples, held by hand or by a trigger.
import type { Core } from "../core/core";
import { button, h, newId, select, say } from "../page/dom";
import { CursorTable } from "../plot/cursors";
import { Plots } from "../plot/plots";
import { Samples } from "../plot/samples";
import { EDGES, find, type Edge } from "../plot/trigger";
import type { Chosen } from "../project/chosen";
import { onLanguage, t, type Key } from "../text/language";
import type { Operands } from "./operands";
import { Signals } from "./signals";

const EVERY_MS = [1, 2, 5, 10, 20, 50, 100, 1000];
const WINDOWS_S = [0.1, 0.5, 1, 2, 5, 10, 30, 60];
/** So much of the window is before the trigger. */
const BEFORE = 0.2;
/** From picture to picture, so that work remains for the rest. */
const DRAW_MS = 50;

export class Scope {
  readonly element: HTMLElement;
  private signals: Signals;
  private samples = new Samples(0);
  private plots = new Plots();
  private cursors = new CursorTable(this.plots);
  private everyMs = 10;
  private windowMs = 10_000;
  private isHeld = false;
  private isShown = false;
  /** Whether it was ever looked at: before that nothing is asked for. */
  private isUsed = false;
  private edge: Edge = "none";
  private signal = "";
  private level = h("input", {
    attributes: { type: "number", step: "any" },
    set: { value: "0.5" },
  });
  private signalSelect = h("select", { label: "triggerSignal" });
  private searched = 0;
  private triggeredAt: number | null = null;
  private hold: HTMLButtonElement;
  private state = h("p", { class: "hint", attributes: { "aria-live": "polite" } });
  private drawAt = 0;

  constructor(
    private core: Core,
    operands: Operands,
    chosen: Chosen,
  ) {
    this.signals = new Signals(operands, chosen, "scope", () => this.isUsed && this.begin());
    this.hold = button("hold", () => this.setHeld(!this.isHeld));
    this.element = h("div", {}, this.signals.element, this.controls(), this.state);
    this.element.append(this.plots.element, this.cursors.element);
    core.on("samples", ({ times, columns, lost }) => this.take(times, columns, lost));
    onLanguage(() => this.showState());
    this.fillSignals();
    this.showState();
  }

  private controls(): HTMLElement {
    const times = (values: number[], unit: string) =>
      values.map((value) => [String(value), { plain: `${value} ${unit}` }] as const);
    const every = select("sampleEvery", times(EVERY_MS, "ms"), String(this.everyMs), (value) => {
      this.everyMs = Number(value);
      this.begin();
    });
    const span = select("window", times(WINDOWS_S, "s"), String(this.windowMs / 1000), (value) => {
      this.windowMs = Number(value) * 1000;
      this.arm();
      this.draw();
    });
    const edges = EDGES.map((edge) => [edge, `trigger-${edge}`] as const);
    const trigger = select("trigger", edges, "none", (edge) => {
      this.edge = edge;
      this.arm();
    });
    this.signalSelect.addEventListener("change", () => {
      this.signal = this.signalSelect.value;
      this.arm();
    });
    this.level.addEventListener("input", () => this.arm());
    say(this.level, "aria-label", "triggerLevel");
    this.hold.setAttribute("aria-pressed", "false");
    return h(
      "div",
      { class: "controls" },
      labelled("sampleEvery", every),
      labelled("window", span),
      labelled("trigger", trigger),
      this.signalSelect,
      this.level,
      this.hold,
      button("again", () => this.arm()),
    );
  }

  /** Shows one more signal. */
  add(signal: string): void {
    this.signals.add([signal]);
  }

  shown(isShown: boolean): void {
    this.isShown = isShown;
    if (isShown && !this.isUsed) {
      this.isUsed = true;
      this.begin();
    }
    if (isShown) this.draw();
  }

  /** Asks for samples of the signals that are chosen, from now on. */
  private begin(): void {
    const { names } = this.signals;
    this.samples = new Samples(names.length);
    this.fillSignals();
    this.arm();
    this.send();
    this.cursors.update(names);
    this.draw();
  }

  private send(): void {
    const signals = this.isHeld ? [] : this.signals.names;
    this.core.tell({ do: "scope", signals, everyMs: this.everyMs });
  }

  private setHeld(isHeld: boolean): void {
    this.isHeld = isHeld;
    this.hold.setAttribute("aria-pressed", String(isHeld));
    this.send();
    this.showState();
  }

  private fillSignals(): void {
    const { names } = this.signals;
    this.signalSelect.replaceChildren(
      ...names.map((name) => h("option", { set: { value: name } }, name)),
    );
    if (!names.includes(this.signal)) this.signal = names[0] ?? "";
    this.signalSelect.value = this.signal;
  }

  /** Waits for the trigger from now on. */
  private arm(): void {
    this.triggeredAt = null;
    this.searched = this.samples.times.length;
    const hasTrigger = this.edge !== "none";
    this.signalSelect.hidden = !hasTrigger;
    this.level.hidden = !hasTrigger;
    this.showState();
  }

  private take(times: number[], columns: number[][], isLost: boolean): void {
    if (this.isHeld) return;
    const before = this.samples.times.length;
    this.samples.add(times, columns, isLost);
    if (this.samples.times.length < before) this.searched = 0;
    if (isLost) this.showState();
    this.search();
    if (!this.isShown || this.drawAt !== 0) return;
    this.drawAt = window.setTimeout(() => {
      this.drawAt = 0;
      requestAnimationFrame(() => this.draw());
    }, DRAW_MS);
  }

  private search(): void {
    if (this.edge === "none" || this.triggeredAt !== null) return;
    const signal = this.signals.names.indexOf(this.signal);
    const column = this.samples.columns[signal];
    if (!column) return;
    const trigger = { edge: this.edge, signal, level: Number(this.level.value) };
    const at = find(trigger, column, this.searched);
    this.searched = column.length;
    if (at < 0) return;
    this.triggeredAt = this.samples.times[at] ?? null;
    this.showState();
  }

  private draw(): void {
    if (!this.isShown) return;
    const { names } = this.signals;
    const last = this.samples.times.at(-1) ?? 0;
    const before = this.windowMs * BEFORE;
    const end = this.triggeredAt === null ? last : this.triggeredAt + this.windowMs - before;
    const begin = Math.max(0, end - this.windowMs);
    const range: [number, number] = [begin, begin + this.windowMs];
    this.plots.draw(names, this.samples.within(...range), range, this.triggeredAt);
    this.cursors.update(names);
    this.element.classList.toggle("without-signals", names.length === 0);
  }

  private showState(): void {
    const words: string[] = [];
    if (this.signals.names.length === 0) words.push(t("noSignals"));
    if (this.isHeld) words.push(t("held"));
    if (this.edge !== "none")
      words.push(
        this.triggeredAt === null
          ? t("waitingForTrigger")
          : t("triggeredAt", (this.triggeredAt / 1000).toFixed(3)),
      );
    if (this.samples.losses > 0) words.push(t("samplesLost", this.samples.losses));
    this.state.textContent = words.join(" · ");
    this.state.classList.toggle("bad", this.samples.losses > 0);
  }
}

/** A control with its words before it. */
export function labelled(text: Key, control: HTMLElement): HTMLElement {
  control.id ||= newId();
  return h(
    "div",
    { class: "labelled" },
    h("label", { text, attributes: { for: control.id } }),
    control,
  );
}

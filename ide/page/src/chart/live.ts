// Which steps are active, as the core tells, by the names of chart and step: while a chart is edited
// they are shown as they were told of the text before.
import type { Core } from "../core/core";
import { tellsOfProgram, type Header } from "../page/header";
import type { ChartDocument } from "./document";
import type { Item } from "./drawn";
import type { ElementId } from "./protocol";

export class Live {
  /** What was asked for: the names of the steps are those of the text at that time. */
  private asked: { id: number; names: string[][] } = { id: 0, names: [] };
  private told: { id: number; steps: (boolean | null)[][] } = { id: 0, steps: [] };
  private states = new Map<string, boolean | null>();
  private isShown = false;
  /** So often the core was asked: the last answer counts. */
  private questions = 0;

  constructor(
    private core: Core,
    private document: ChartDocument,
    header: Header,
    private changed: () => void,
  ) {
    document.onDrawn((_drawn, before) => {
      // What is active in one file says nothing of another one.
      if (!before) this.states.clear();
      void this.ask();
    });
    core.on("problems", () => void this.ask());
    core.on("situation", (situation) => {
      this.told = situation;
      this.take();
    });
    header.onStatus((status) => {
      if (tellsOfProgram(status) || this.told.id === 0) return;
      this.told = { id: 0, steps: [] };
      this.states.clear();
      this.changed();
    });
  }

  /** Steps are asked for only while they can be seen. */
  shown(isShown: boolean): void {
    const was = this.isShown;
    this.isShown = isShown;
    if (isShown || was) void this.ask();
  }

  private async ask(): Promise<void> {
    const { document } = this;
    const file = (this.isShown && document.file) || "";
    // The core knows the text as it is; it is asked when that is drawn.
    if (file !== "" && !document.isUpToDate) return;
    const number = ++this.questions;
    const names = (document.drawn?.charts.sheets ?? []).map(({ name, steps }) =>
      steps.map(({ fullName }) => keyOf(name, fullName)),
    );
    const found = await this.core.ask({ do: "chart", file }).catch(() => null);
    if (number !== this.questions) return;
    this.asked = { id: found?.id ?? 0, names };
    this.take();
  }

  private take(): void {
    const { id, names } = this.asked;
    if (this.told.id !== id || id === 0) return;
    this.states.clear();
    for (const [at, steps] of names.entries())
      for (const [index, key] of steps.entries())
        this.states.set(key, this.told.steps[at]?.[index] ?? null);
    this.changed();
  }

  /** Whether a step is active, and a transition enabled: all steps before it are active. */
  state(item: Item): boolean | null {
    const { drawn } = this.document;
    const { sheet } = item;
    if (item.kind === "step") {
      const key = keyOf(drawn?.sheet(sheet)?.name ?? "", item.element.fullName);
      return this.states.get(key) ?? null;
    }
    const before = item.element.from.map((id: ElementId) => drawn?.at(sheet, id));
    const states = before.map((step) => (step ? this.state(step) : null));
    if (states.length === 0 || states.includes(null)) return null;
    return states.every(Boolean);
  }
}

/** Tells the steps of all charts of a file apart. */
const keyOf = (chart: string, step: string) => `${chart} ${step}`;

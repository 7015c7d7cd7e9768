// Which steps are active, as the core tells, by their names: while a chart is edited they are shown
// as they were told of the text before.
import type { Core } from "../core/core";
import type { Editors } from "../editor/editors";
import { tellsOfProgram, type Header } from "../page/header";
import type { ChartDocument } from "./document";
import type { Item } from "./drawn";
import type { ElementId } from "./protocol";

export class Live {
  private id = 0;
  private told: { id: number; steps: (boolean | null)[][] } = { id: 0, steps: [] };
  private states = new Map<string, boolean | null>();
  private isShown = false;

  constructor(
    private core: Core,
    private document: ChartDocument,
    editors: Editors,
    header: Header,
    private changed: () => void,
  ) {
    document.onDrawn((_drawn, before) => {
      // What is active in one file says nothing of another one.
      if (!before) this.states.clear();
      void this.ask();
    });
    editors.onCurrent(() => void this.ask());
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
    const file = (this.isShown && this.document.file) || "";
    const { drawn } = this.document;
    const found = await this.core.ask({ do: "chart", file }).catch(() => null);
    if (drawn !== this.document.drawn) return;
    this.id = found?.id ?? 0;
    this.take();
  }

  private take(): void {
    const sheets = this.document.drawn?.charts.sheets ?? [];
    if (this.told.id !== this.id || this.id === 0) return;
    this.states.clear();
    for (const [at, sheet] of sheets.entries())
      for (const [index, step] of sheet.steps.entries())
        this.states.set(`${at} ${step.fullName}`, this.told.steps[at]?.[index] ?? null);
    this.changed();
  }

  /** Whether a step is active, and a transition enabled: all steps before it are active. */
  state(item: Item): boolean | null {
    const { sheet } = item;
    if (item.kind === "step") return this.states.get(`${sheet} ${item.element.fullName}`) ?? null;
    const before = item.element.from.map((id: ElementId) => this.document.drawn?.at(sheet, id));
    const states = before.map((step) => (step ? this.state(step) : null));
    if (states.length === 0 || states.includes(null)) return null;
    return states.every(Boolean);
  }
}

// Macro-steps whose charts are folded: they are left out of the drawing, and their room is free.
import type { ChartEditor } from "./editor";
import type { ChartSheet } from "./protocol";

export class Folding {
  constructor(private editor: ChartEditor) {}

  /** The chart of the macro-step that has the focus. */
  get chosen(): ChartSheet | null {
    const { scene } = this.editor;
    const item = scene?.focus;
    const number = item?.kind === "step" ? item.element.expansion : null;
    return (number !== null && scene?.drawn.sheet(number)) || null;
  }

  /** The charts of all macro-steps. */
  private get all(): ChartSheet[] {
    const { drawn } = this.editor.document;
    const numbers = (drawn?.items ?? []).flatMap((item) =>
      item.kind === "step" ? (item.element.expansion ?? []) : [],
    );
    return [...new Set(numbers)].flatMap((number) => drawn?.sheet(number) ?? []);
  }

  /** Whether no chart of a macro-step is folded. */
  get areAllShown(): boolean {
    return this.all.every(({ isFolded }) => !isFolded);
  }

  toggle(): void {
    const { chosen } = this;
    if (chosen) this.fold([chosen], !chosen.isFolded);
  }

  toggleAll(): void {
    this.fold(this.all, this.areAllShown);
  }

  /** A chart that is asked for is shown. */
  unfold(sheet: ChartSheet | undefined): void {
    if (sheet?.isFolded) this.fold([sheet], false);
  }

  private fold(sheets: ChartSheet[], isFolded: boolean): void {
    this.editor.document.fold(
      sheets.map(({ name }) => name),
      isFolded,
    );
  }
}

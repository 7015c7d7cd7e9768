// The file in the editor whose diagrams are drawn. Its text is the file, and nothing else is kept.
import { Refusal } from "../core/core";
import { DrawingsModule, Overtaken } from "../drawings/module";
import type { Editors } from "../editor/editors";
import { notice } from "../page/notices";
import type { Project } from "../project/project";
import { t } from "../text/language";
import type { Diagrams, Questions } from "./protocol";

/** So long nothing is drawn while a text is being written. */
const QUIET_MS = 120;
const OF_DIAGRAMS = /\.fbd$/i;
/** Files that blocks of the project can be in. */
const OF_BLOCKS = /\.(fbd|st)$/i;

const NOTHING = { width: 0, height: 0, sheets: [], mistake: null };

export class DiagramDocument {
  file: string | null = null;
  drawn: Diagrams | null = null;
  private module = new DrawingsModule<Questions>((message) =>
    notice(t("drawingBroken", message), true),
  );
  /** What was asked about last. */
  private asked = "";
  private isShown = false;
  private timer = 0;
  private listeners: ((isOther: boolean) => void)[] = [];

  constructor(
    private editors: Editors,
    private project: Project,
  ) {
    editors.onCurrent(() => this.soon(0));
    project.onFiles(() => this.soon());
    project.onEdited(() => this.soon());
  }

  /** Is told of each other drawing, and whether it is of another file. */
  onDrawn(listener: (isOther: boolean) => void): void {
    this.listeners.push(listener);
  }

  /** A text is drawn only while that can be seen. */
  shown(isShown: boolean): void {
    this.isShown = isShown;
    this.soon(0);
  }

  private soon(after = QUIET_MS): void {
    clearTimeout(this.timer);
    if (this.isShown) this.timer = window.setTimeout(() => void this.draw(), after);
  }

  private async draw(): Promise<void> {
    const file = this.editors.current;
    const text = file === null ? undefined : this.project.text(file);
    if (file === null || text === undefined || !OF_DIAGRAMS.test(file)) {
      this.asked = "";
      return this.take(null, null);
    }
    const names = this.project.names().filter((name) => name !== file && OF_BLOCKS.test(name));
    const wish = { name: file, text, others: names.map((name) => this.project.text(name) ?? "") };
    const asked = JSON.stringify(wish);
    if (asked === this.asked) return;
    this.asked = asked;
    try {
      const drawn = await this.module.ask({ do: "diagrams", ...wish });
      if (this.asked === asked) this.take(file, drawn);
    } catch (error) {
      if (error instanceof Refusal) this.take(file, { ...NOTHING, obstacle: error.message });
      else if (!(error instanceof Overtaken)) throw error;
      else this.asked = "";
    }
  }

  private take(file: string | null, drawn: Diagrams | null): void {
    const isOther = file !== this.file;
    if (!drawn && !this.drawn && !isOther) return;
    Object.assign(this, { file, drawn });
    for (const listener of this.listeners) listener(isOther);
  }

  /** Leads to a line of the text. */
  goTo(line: number): void {
    if (this.file !== null) this.editors.openLine(this.file, line);
  }
}

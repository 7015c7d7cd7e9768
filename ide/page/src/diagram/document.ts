// The file in the editor whose diagrams are drawn. Its text is all that is kept, and a change of a
// diagram is one of it.
import { redo, undo } from "@codemirror/commands";
import { Refusal } from "../core/core";
import { DrawingsModule, Overtaken } from "../drawings/module";
import type { Editors } from "../editor/editors";
import type { Project } from "../project/project";
import { t } from "../text/language";
import type { Block, DiagramEdit, DiagramElement, Diagrams, Questions, Wish } from "./protocol";

/** So long nothing is drawn while a text is being written. */
const QUIET_MS = 120;
const OF_DIAGRAMS = /\.fbd$/i;
/** Files that blocks of the project can be in. */
const OF_BLOCKS = /\.(fbd|st)$/i;

const NOTHING = { width: 0, height: 0, sheets: [], mistake: null };

export class DiagramDocument {
  file: string | null = null;
  drawn: Diagrams | null = null;
  private module = new DrawingsModule<Questions>();
  /** What was asked about last. */
  private asked = "";
  private isShown = false;
  private timer = 0;
  /** The change that comes after all those before. */
  private turn: Promise<unknown> = Promise.resolve();
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

  /** The text in the editor as it is, if it can have diagrams. */
  private wish(): Wish | null {
    const name = this.editors.current;
    const text = name === null ? undefined : this.project.text(name);
    if (name === null || text === undefined || !OF_DIAGRAMS.test(name)) return null;
    const names = this.project.names().filter((one) => one !== name && OF_BLOCKS.test(one));
    return { name, text, others: names.map((one) => this.project.text(one) ?? "") };
  }

  private async draw(): Promise<void> {
    const wish = this.wish();
    if (!wish) {
      this.asked = "";
      return this.take(null, null);
    }
    const asked = JSON.stringify(wish);
    if (asked === this.asked) return;
    this.asked = asked;
    try {
      const drawn = await this.module.ask({ do: "diagrams", ...wish });
      if (this.asked === asked) this.take(wish.name, drawn);
    } catch (error) {
      if (error instanceof Refusal) this.take(wish.name, { ...NOTHING, obstacle: error.message });
      else if (!(error instanceof Overtaken)) throw error;
      else this.asked = "";
    }
  }

  /** One change, as one of the text; gives the elements that are new. Fails with a [`Refusal`]. */
  edit(diagram: number, edit: DiagramEdit): Promise<string[]> {
    const turn = this.turn.then(() => this.carryOut(diagram, edit));
    this.turn = turn.catch(() => {});
    return turn;
  }

  private async carryOut(diagram: number, edit: DiagramEdit): Promise<string[]> {
    const wish = this.wish();
    if (!wish) throw new Refusal(t("diagramNothing"));
    const answer = await this.module.ask({ do: "editDiagram", ...wish, diagram, edit });
    if (this.project.text(wish.name) !== wish.text) throw new Refusal(t("diagramChanged"));
    this.editors.replace(wish.name, answer.text);
    this.asked = JSON.stringify({ ...wish, text: answer.text });
    // A large text and a large drawing are tasks of their own.
    await new Promise((done) => setTimeout(done));
    this.take(wish.name, answer.diagrams);
    return answer.new;
  }

  /** Elements as a text that can be pasted. */
  async copy(diagram: number, elements: string[]): Promise<string> {
    const wish = this.wish();
    if (!wish) throw new Refusal(t("diagramNothing"));
    return this.module.ask({ do: "copyDiagram", ...wish, diagram, elements });
  }

  /** The blocks that there are. */
  async blocks(): Promise<Block[]> {
    const wish = this.wish();
    return wish ? this.module.ask({ do: "blocks", ...wish }) : [];
  }

  /** Takes the last change of the text back, or that. */
  goBack(isUndo: boolean): void {
    const view = this.file === null ? undefined : this.editors.viewOf(this.file);
    if (view) (isUndo ? undo : redo)(view);
  }

  private take(file: string | null, drawn: Diagrams | null): void {
    const isOther = file !== this.file;
    if (!drawn && !this.drawn && !isOther) return;
    Object.assign(this, { file, drawn });
    for (const listener of this.listeners) listener(isOther);
  }

  /** Where the name of an element begins in the text of the editor. */
  nameAt({ line, column }: DiagramElement): { file: string; at: number } | null {
    const document = this.file === null ? undefined : this.editors.viewOf(this.file)?.state.doc;
    if (this.file === null || !document || line > document.lines) return null;
    const { from, text } = document.line(line);
    return { file: this.file, at: from + [...text].slice(0, column - 1).join("").length };
  }

  /** Leads to a line of the text. */
  goTo(line: number): void {
    if (this.file !== null) this.editors.openLine(this.file, line);
  }
}

// The file in the editor whose charts are drawn. Its text is the file, and nothing else is kept: an
// edit's answer becomes one change of the text, and every other change of it is drawn anew.
import { redo, redoDepth, undo, undoDepth } from "@codemirror/commands";
import { Refusal } from "../core/core";
import type { Editors } from "../editor/editors";
import type { Project } from "../project/project";
import { t } from "../text/language";
import { Overtaken, type DrawingsModule } from "../drawings/module";
import { Drawn, type Item } from "./drawn";
import type { Charts, Edit, ElementId, Judged, Judgement, Questions } from "./protocol";

/** So long nothing is drawn while a text is being written. */
const QUIET_MS = 120;
/** Files of charts. */
const OF_CHARTS = /\.sfc$/i;

const NOTHING = { width: 0, height: 0, sheets: [], mistake: null };

/** Finds an element of the drawing before in this one. */
export type Same = (item: Item) => Item | undefined;
type Listener = (drawn: Drawn | null, before: Drawn | null, find: Same) => void;

export class ChartDocument {
  file: string | null = null;
  drawn: Drawn | null = null;
  /** The text that is drawn. */
  text: string | null = null;
  /** Counts the texts that the module has read: elements of another one are others. */
  reading = 0;
  /** The names of charts that are folded. */
  private folded = new Set<string>();
  /** The text that the module has. */
  private held: string | null = null;
  private turn: Promise<unknown> = Promise.resolve();
  private allowedAsked = 0;
  private isShown = false;
  private timer = 0;
  private listeners: Listener[] = [];

  constructor(
    private module: DrawingsModule<Questions>,
    private editors: Editors,
    private project: Project,
  ) {
    editors.onCurrent(() => this.soon(0));
    project.onFiles(() => this.soon());
    project.onEdited((file) => file === this.file && this.soon());
  }

  /** Is told of each other drawing. */
  onDrawn(listener: Listener): void {
    this.listeners.push(listener);
  }

  /** A text is drawn only while that can be seen. */
  shown(isShown: boolean): void {
    this.isShown = isShown;
    this.soon(0);
  }

  /** Whether what is drawn is the text as it is in the editor. */
  get isUpToDate(): boolean {
    return this.file !== null && this.project.text(this.file) === this.text;
  }

  /** Whether a first step can be put into the file. */
  get canBegin(): boolean {
    const { drawn, file } = this;
    return !!drawn?.isEmpty && drawn.isEditable && file !== null;
  }

  /** Folds charts, or shows them again. */
  fold(names: string[], isFolded: boolean): void {
    for (const name of names)
      if (isFolded) this.folded.add(name);
      else this.folded.delete(name);
    this.held = null;
    this.soon(0);
  }

  private soon(after = QUIET_MS): void {
    clearTimeout(this.timer);
    if (!this.isShown) return;
    this.timer = window.setTimeout(() => void this.inTurn(() => this.draw()), after);
  }

  /** Does one thing after the other: an answer belongs to the text that it was asked with. */
  private inTurn<T>(act: () => Promise<T>): Promise<T> {
    const done = this.turn.then(act);
    this.turn = done.catch(() => {});
    return done;
  }

  private async draw(): Promise<void> {
    const file = this.editors.current;
    const text = file === null ? undefined : this.project.text(file);
    if (file === null || text === undefined || !OF_CHARTS.test(file))
      return this.take(null, null, null);
    if (file === this.file && text === this.text && text === this.held) return;
    this.held = text;
    this.reading += 1;
    try {
      const charts = await this.module.ask({ do: "draw", ...this.wish(file, text) });
      if (this.editors.current === file && this.project.text(file) === text)
        this.take(file, text, charts);
    } catch (error) {
      const obstacle = error instanceof Refusal ? error.message : null;
      if (obstacle !== null) this.take(file, text, { ...NOTHING, obstacle });
      else if (!(error instanceof Overtaken)) throw error;
      // A module that has ended gives elements other names when it begins anew.
      else this.held = null;
    }
  }

  private take(file: string | null, text: string | null, charts: Charts | null): void {
    const before = this.file === file ? this.drawn : null;
    if (!charts && !this.drawn && this.file === file) return;
    const drawn = charts && new Drawn(charts);
    Object.assign(this, { file, text, drawn });
    this.tell(before, (item) => (before ? drawn?.like(item, before) : undefined));
  }

  private tell(before: Drawn | null, same: Same): void {
    for (const listener of this.listeners) listener(this.drawn, before, same);
  }

  /** All of these edits, as one change of the text, or none; which elements are to be selected.
   * Fails with a [`Refusal`]. */
  edit(chart: number, edits: Edit[], reading = this.reading): Promise<ElementId[]> {
    return this.inTurn(() => this.carryOut(chart, edits, reading));
  }

  private async carryOut(chart: number, edits: Edit[], reading: number): Promise<ElementId[]> {
    const { file, text } = await this.ready();
    if (reading !== this.reading) throw new Refusal(t("chartChangedMeanwhile"));
    const wish = { ...this.wish(file, text), chart, edits };
    const answer = await this.module.ask({ do: "edit", ...wish });
    this.held = answer.text;
    if (this.project.text(file) !== text) throw new Refusal(t("chartChangedMeanwhile"));
    this.editors.replace(file, answer.text);
    // A large text and a large drawing are tasks of their own.
    await new Promise((done) => setTimeout(done));
    const [before, drawn] = [this.drawn, new Drawn(answer.charts)];
    Object.assign(this, { file, text: answer.text, drawn });
    this.tell(before, (item) => drawn.byKeyOf(item.key));
    return answer.select;
  }

  private wish(file: string, text: string) {
    return { text, name: nameOf(file), folded: [...this.folded] };
  }

  /** Whether conditions of what is drawn are TRUE with values; nothing of another text. */
  judge(transitions: Judged[], reading: number): Promise<Judgement[]> {
    return this.inTurn(async () => {
      const { file, text } = this;
      if (file === null || text === null || text !== this.held || reading !== this.reading)
        throw new Overtaken();
      return this.module.ask({ do: "judge", text, name: nameOf(file), transitions });
    });
  }

  /** Which of these edits would be refused, and why. */
  allowed(chart: number, edits: Edit[]): Promise<(string | null)[]> {
    const number = ++this.allowedAsked;
    return this.inTurn(async () => {
      const { file, text } = await this.ready();
      if (number !== this.allowedAsked) throw new Overtaken();
      return this.module.ask({ do: "allowed", text, name: nameOf(file), chart, edits });
    });
  }

  /** Steps as a text that can be pasted. */
  copy(chart: number, steps: ElementId[]): Promise<string> {
    return this.inTurn(async () => {
      const { file, text } = await this.ready();
      return this.module.ask({ do: "copy", text, name: nameOf(file), chart, steps });
    });
  }

  /** What is drawn is what the editor has. */
  private async ready(): Promise<{ file: string; text: string }> {
    clearTimeout(this.timer);
    await this.draw();
    const { file, text } = this;
    if (file === null || text === null) throw new Refusal(t("chartNothing"));
    return { file, text };
  }

  /** Whether there is a change of the text to be taken back, or one that was. */
  canGoBack(isUndo: boolean): boolean {
    const view = this.file === null ? undefined : this.editors.viewOf(this.file);
    return view !== undefined && (isUndo ? undoDepth : redoDepth)(view.state) > 0;
  }

  /** Takes the last change of the text back, or that. */
  async goBack(isUndo: boolean): Promise<void> {
    const view = this.file === null ? undefined : this.editors.viewOf(this.file);
    if (!view) return;
    (isUndo ? undo : redo)(view);
    await this.inTurn(() => this.ready());
  }

  /** Marks a line of the text, without leaving what can be seen. */
  mark(line: number): void {
    const view = this.file === null ? undefined : this.editors.viewOf(this.file);
    if (!view || line < 1 || line > view.state.doc.lines) return;
    view.dispatch({ selection: { anchor: view.state.doc.line(line).from } });
  }

  /** Leads to a line of the text. */
  goTo(line: number): void {
    if (this.file !== null) this.editors.openLine(this.file, line);
  }
}

/** What a chart is called that is not there yet. */
function nameOf(file: string): string {
  const stem = file.replace(/^.*\//, "").replace(/\.\w+$/, "");
  const name = stem.replace(/\W/g, "_");
  return /^[A-Za-z_]/.test(name) ? name : `_${name}`;
}

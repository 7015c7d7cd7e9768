// The block of IEC 61499 in the editor, and what was done with it. All of that is done again for each
// answer, so it stays while the text is changed.
import { Refusal } from "../core/core";
import { DrawingsModule, Overtaken } from "../drawings/module";
import type { Editors } from "../editor/editors";
import type { Project } from "../project/project";
import type { Events, Questions } from "./protocol";

/** So long nothing is asked while a text is being written. */
const QUIET_MS = 120;
const OF_EVENTS = /\.fbt$/i;

/** A block after all that was done with it, or why there is none. */
export type Shown = { events: Events } | { refused: string } | null;

export class EventsDocument {
  file: string | null = null;
  /** What was done with it, as `uno200 events` takes it. */
  lines: string[] = [];
  private module = new DrawingsModule<Questions>();
  private isShown = false;
  private timer = 0;
  private asked = 0;
  /** What comes after all those before. */
  private turn: Promise<unknown> = Promise.resolve();

  constructor(
    private editors: Editors,
    private project: Project,
    /** Is told what there is, and whether it is another file. */
    private show: (shown: Shown, isOther: boolean) => void,
  ) {
    editors.onCurrent(() => this.soon(0));
    project.onEdited(() => this.soon());
  }

  shown(isShown: boolean): void {
    this.isShown = isShown;
    this.soon(0);
  }

  private soon(after = QUIET_MS): void {
    clearTimeout(this.timer);
    if (this.isShown) this.timer = window.setTimeout(() => void this.ask(), after);
  }

  private async ask(): Promise<void> {
    const name = this.editors.current;
    const file = name !== null && OF_EVENTS.test(name) ? name : null;
    const isOther = file !== this.file;
    if (isOther) Object.assign(this, { file, lines: [] });
    const text = file === null ? undefined : this.project.text(file);
    const number = ++this.asked;
    if (file === null || text === undefined) return this.show(null, isOther);
    const shown = await this.answer(text, file);
    if (shown && number === this.asked) this.show(shown, isOther);
  }

  private async answer(text: string, name: string): Promise<Shown> {
    try {
      return { events: await this.module.ask({ do: "events", text, name, lines: this.lines }) };
    } catch (error) {
      if (error instanceof Refusal) return { refused: error.message };
      if (!(error instanceof Overtaken)) throw error;
      return null;
    }
  }

  /** Does one thing more with it, after all those before; why it cannot be done, or null. */
  add(line: string): Promise<string | null> {
    const turn = this.turn.then(() => this.carryOut(line));
    this.turn = turn.catch(() => {});
    return turn;
  }

  private async carryOut(line: string): Promise<string | null> {
    const text = this.file === null ? undefined : this.project.text(this.file);
    if (this.file === null || text === undefined) return null;
    const at = this.lines.push(line) - 1;
    const number = ++this.asked;
    const shown = await this.answer(text, this.file);
    const told = shown && "events" in shown ? shown.events.told[at] : undefined;
    if (told?.isWrong) {
      // What is not understood is not done.
      this.lines.splice(at, 1);
      this.soon(0);
      return told.text;
    }
    if (shown && number === this.asked) this.show(shown, false);
    return null;
  }

  /** Takes the last thing back, or all. */
  takeBack(isAll: boolean): void {
    this.lines.splice(isAll ? 0 : -1);
    this.soon(0);
  }

  /** Leads to a line of the text. */
  goTo(line: number): void {
    if (this.file !== null) this.editors.openLine(this.file, line);
  }
}

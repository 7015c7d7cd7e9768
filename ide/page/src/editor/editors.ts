// All editors: which files are open where, with texts, histories and problems. What is written is
// told to the project.
import { isolateHistory } from "@codemirror/commands";
import {
  Compartment,
  EditorState,
  StateEffect,
  type Extension,
  Transaction,
  type TransactionSpec,
} from "@codemirror/state";
import { EditorView, keymap, type KeyBinding } from "@codemirror/view";
import type { Core } from "../core/core";
import type { Edit, Line, Place, Problem } from "../core/protocol";
import { iconButton } from "../page/dom";
import { icon } from "../page/icons";
import type { Project } from "../project/project";
import { notice } from "../page/notices";
import { onLanguage, t } from "../text/language";
import { assist } from "./assist";
import { colours } from "./colours";
import { LiveValues, type Chosen } from "./live";
import { Pane, type Sheet } from "./pane";
import { phrases } from "./phrases";
import { show as showProblems, type Explain } from "./problems";
import { setup } from "./setup";
import { mark, partOf, rememberTogether, samePart, type Part } from "./together";

interface Wishes {
  chosen: Chosen;
  explain: Explain;
  renameFile(file: string): void;
  keys: readonly KeyBinding[];
}

const PANES_MAX = 2;

export class Editors {
  readonly live: LiveValues;
  readonly panes: Pane[] = [];
  private sheets = new Map<string, Sheet>();
  private problems: Problem[] = [];
  private active: Pane;
  private words = new Compartment();
  private currentListeners: ((file: string | null) => void)[] = [];
  /** Files that one change has changed together, by its mark. */
  private changedTogether = new Map<number, string[]>();
  private isFollowing = false;
  private viewListeners: (() => void)[] = [];
  private cursorListeners: (() => void)[] = [];

  constructor(
    readonly element: HTMLElement,
    private core: Core,
    private project: Project,
    private wishes: Wishes,
  ) {
    this.live = new LiveValues(wishes.chosen);
    this.active = this.addPane();
    project.onOpened(() => this.reopen());
    project.onRenamed((file, to) => this.renameFile(file, to));
    project.onFiles(() => this.dropGone());
    core.on("problems", ({ problems }) => this.setProblems(problems));
    onLanguage(() => this.updateAll(() => ({ effects: this.words.reconfigure(phrases()) })));
  }

  private addPane(): Pane {
    const split = iconButton(icon("split"), "splitEditor", () => this.split());
    const pane = new Pane(
      {
        sheet: (file) => this.sheets.get(file),
        chosen: (pane) => this.choose(pane),
        closed: (pane, file) => this.close(pane, file),
        renamed: this.wishes.renameFile,
      },
      this.panes.length === 0
        ? [split]
        : [iconButton(icon("close"), "closePane", () => this.join())],
    );
    this.panes.push(pane);
    pane.name(this.panes.length);
    this.element.append(pane.element);
    return pane;
  }

  /** The file that is being worked on. */
  get current(): string | null {
    return this.active.current;
  }

  /** The editor that is being worked in. */
  get view(): EditorView {
    return this.active.view;
  }

  /** The line of the cursor in the file that is being worked in, from 1; null for another file. */
  cursorLine(file: string): number | null {
    if (file !== this.current) return null;
    const { state } = this.view;
    return state.doc.lineAt(state.selection.main.head).number;
  }

  private choose(pane: Pane): void {
    this.active = pane;
    this.changed();
  }

  private changed(): void {
    for (const listener of this.currentListeners) listener(this.current);
    for (const listener of this.viewListeners) listener();
  }

  /** Is told which file is being worked on. */
  onCurrent(listener: (file: string | null) => void): void {
    this.currentListeners.push(listener);
  }

  /** Is told when other lines can be seen. */
  onView(listener: () => void): void {
    this.viewListeners.push(listener);
  }

  /** Is told when the cursor is elsewhere, or the text around it is another one. */
  onCursor(listener: () => void): void {
    this.cursorListeners.push(listener);
  }

  /** Shows a file, and a place in it. */
  open(file: string, range?: { from: number; to: number }, focus = true): void {
    if (!this.sheet(file)) return;
    const pane = this.panes.find((pane) => pane.files.includes(file)) ?? this.active;
    if (pane.current !== file) pane.show(file);
    this.active = pane;
    if (range) {
      const { length } = pane.view.state.doc;
      const anchor = Math.min(range.from, length);
      const selection = { anchor, head: Math.min(range.to, length) };
      const effects = EditorView.scrollIntoView(anchor, { y: "center" });
      pane.view.dispatch({ selection, effects });
    }
    if (focus) pane.view.focus();
    this.changed();
  }

  openLine(file: string, line: number): void {
    if (!this.sheet(file)) return;
    const { doc } = this.stateOf(file);
    const { from, to } = doc.line(Math.max(1, Math.min(line, doc.lines)));
    this.open(file, { from, to });
  }

  openPlace(place: Place): void {
    this.open(place.file, place);
  }

  /** Shows the file on both sides; the second side has it alone then. */
  split(): void {
    const file = this.active.current;
    const other = this.panes.find((pane) => pane !== this.active);
    const goal = other ?? (this.panes.length < PANES_MAX ? this.addPane() : undefined);
    if (!goal || file === null) return;
    this.active.remove(file);
    goal.show(file);
    this.active = goal;
    goal.view.focus();
    this.changed();
  }

  /** Ends the second side. */
  join(): void {
    const [first, second] = this.panes;
    if (!first || !second) return;
    second.leave();
    const shown = second.current;
    for (const file of second.files) if (!first.files.includes(file)) first.files.push(file);
    second.current = null;
    second.view.destroy();
    second.element.remove();
    this.panes.pop();
    this.active = first;
    first.show(shown ?? first.current);
    this.changed();
  }

  private close(pane: Pane, file: string): void {
    pane.remove(file);
    if (pane.files.length === 0 && pane === this.panes[1]) this.join();
    this.changed();
  }

  /** Changes texts, of files that are not open too; what is done is one step for Undo. */
  apply(edits: Edit[]): void {
    const files = [...new Set(edits.map((edit) => edit.file))].filter((file) => this.sheet(file));
    const effect = mark();
    if (files.length > 1) this.changedTogether.set(effect.value, files);
    for (const file of files) {
      const changes = edits
        .filter((edit) => edit.file === file)
        .map(({ from, to, text }) => ({ from, to, insert: text }));
      const effects = files.length > 1 ? [effect] : [];
      const annotations = isolateHistory.of("full");
      this.update(file, () => ({ changes, effects, annotations, userEvent: "input.change" }));
    }
  }

  /** What was undone or redone in a file of several that were changed together is in the others. */
  private follow(file: string, transaction: Transaction): void {
    const part = partOf(transaction);
    if (!part || this.isFollowing) return;
    this.isFollowing = true;
    const others = (this.changedTogether.get(part.id) ?? []).filter((other) => other !== file);
    const left = others.filter((other) => this.sheets.has(other) && !this.goWith(other, part));
    this.isFollowing = false;
    if (left.length > 0)
      notice(t(part.isUndo ? "undoElsewhere" : "redoElsewhere", left.join(", ")), true);
  }

  private goWith(file: string, part: Part): boolean {
    const transaction = samePart(this.stateOf(file), part);
    if (transaction) this.update(file, () => transaction);
    return transaction !== null;
  }

  /** Gives a file another text; the cursor stays where nothing has changed. */
  replace(file: string, text: string): void {
    const before = this.project.text(file) ?? "";
    const least = Math.min(before.length, text.length);
    let from = 0;
    while (from < least && before[from] === text[from]) from += 1;
    let same = 0;
    while (same < least - from && before.at(-1 - same) === text.at(-1 - same)) same += 1;
    const changed = text.slice(from, text.length - same);
    this.apply([{ file, from, to: before.length - same, text: changed }]);
  }

  /** Where the file is shown, if it is. */
  viewOf(file: string): EditorView | undefined {
    return this.panes.find((pane) => pane.current === file)?.view;
  }

  showLive(file: string, lines: Line[]): void {
    for (const pane of this.panes) this.live.show(pane.view, pane.current === file ? lines : []);
  }

  private renameFile(file: string, to: string): void {
    for (const pane of this.panes) pane.leave();
    const sheet = this.sheets.get(file);
    if (!sheet) return;
    // Its history stays, and what was changed together with others.
    const effects = StateEffect.reconfigure.of(this.extensions(to));
    const { state } = sheet.state.update({ effects });
    for (const files of this.changedTogether.values())
      if (files.includes(file)) files.splice(files.indexOf(file), 1, to);
    this.sheets.delete(file);
    this.sheets.set(to, { state });
    for (const pane of this.panes) pane.rename(file, to);
    this.changed();
  }

  private sheet(file: string): Sheet | undefined {
    const known = this.sheets.get(file);
    const text = this.project.text(file);
    if (known || text === undefined) return known;
    let state = EditorState.create({ doc: text, extensions: this.extensions(file) });
    state = state.update(this.problemsOf(file)(state)).state;
    const sheet = { state };
    this.sheets.set(file, sheet);
    return sheet;
  }

  private extensions(file: string): Extension {
    return [
      keymap.of(this.wishes.keys),
      setup,
      colours(file),
      assist(this.core, file),
      this.live.extension,
      rememberTogether,
      this.words.of(phrases()),
      EditorView.contentAttributes.of({ "aria-label": file, spellcheck: "false", tabindex: "0" }),
      EditorView.updateListener.of((update) => {
        if (update.docChanged) this.project.edit(file, update.state.doc.toString());
        for (const transaction of update.transactions) this.follow(file, transaction);
        if (update.viewportChanged || update.docChanged)
          for (const listener of this.viewListeners) listener();
        if (update.selectionSet || update.docChanged)
          for (const listener of this.cursorListeners) listener();
      }),
    ];
  }

  private setProblems(problems: Problem[]): void {
    this.problems = problems;
    this.updateAll((file) => this.problemsOf(file)(this.stateOf(file)));
  }

  private problemsOf(file: string): (state: EditorState) => TransactionSpec {
    const problems = this.problems.filter((problem) => problem.file === file);
    return (state) => showProblems(state, problems, this.wishes.explain);
  }

  private stateOf(file: string): EditorState {
    const state = this.viewOf(file)?.state ?? this.sheets.get(file)?.state;
    return state ?? EditorState.create();
  }

  private update(file: string, change: (file: string) => TransactionSpec | Transaction): void {
    const view = this.viewOf(file);
    const sheet = this.sheets.get(file);
    const spec = change(file);
    if (view) return view.dispatch(spec);
    if (!sheet) return;
    const transaction = spec instanceof Transaction ? spec : sheet.state.update(spec);
    sheet.state = transaction.state;
    if (transaction.docChanged) this.project.edit(file, sheet.state.doc.toString());
  }

  private updateAll(spec: (file: string) => TransactionSpec): void {
    for (const file of this.sheets.keys()) this.update(file, spec);
  }

  private reopen(): void {
    for (const pane of this.panes) for (const file of [...pane.files]) pane.remove(file);
    if (this.panes.length > 1) this.join();
    this.sheets.clear();
    this.changedTogether.clear();
    this.problems = [];
    const main = this.project.main() ?? this.project.names()[0];
    if (main !== undefined) this.open(main, undefined, false);
  }

  private dropGone(): void {
    for (const file of [...this.sheets.keys()]) {
      if (this.project.text(file) !== undefined) continue;
      for (const pane of [...this.panes]) if (pane.files.includes(file)) this.close(pane, file);
      this.sheets.delete(file);
    }
  }
}

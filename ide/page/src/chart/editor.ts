// The editor of charts: its parts, and what all of them do with the drawing. The text stays the
// file; there is nothing of a chart here but what is selected and how it is looked at.
import type { Core } from "../core/core";
import type { Editors } from "../editor/editors";
import { button, h } from "../page/dom";
import type { Header } from "../page/header";
import { notice } from "../page/notices";
import type { Project } from "../project/project";
import type { Operands } from "../panels/operands";
import { CHART_WORDS } from "../text/chart_words";
import { addWords, onLanguage } from "../text/language";
import { Canvas } from "./canvas";
import { DrawingsModule, tellRefusal } from "../drawings/module";
import { Commands } from "./commands";
import { ChartDocument, type Same } from "./document";
import { barFrame, type Drawn, type Item } from "./drawn";
import { Field } from "./field";
import { Find } from "./find";
import { Folding } from "./folding";
import { Handle } from "./handle";
import { Keyboard } from "./keyboard";
import { Live } from "./live";
import { Minimap } from "./minimap";
import { Moments } from "./moments";
import { Pictures } from "./picture";
import { Pointer } from "./pointer";
import type { Edit, ElementId, Questions } from "./protocol";
import { actionOf, type Scene } from "./edits";
import { Selection } from "./selection";
import { SetReset } from "./set_reset";
import { Sheets } from "./sheets";
import { Times } from "./times";
import { Tools } from "./tools";

addWords(CHART_WORDS);

export class ChartEditor {
  readonly document: ChartDocument;
  readonly canvas: Canvas;
  readonly selection = new Selection();
  readonly field: Field;
  readonly commands: Commands;
  /** The part of the page in which keys and the clipboard are for the chart. */
  readonly stage: HTMLElement;
  /** The chart that is shown; all for null. */
  only: number | null = null;
  readonly find: Find;
  readonly pictures: Pictures;
  readonly live: Live;
  readonly moments: Moments;
  readonly times: Times;
  readonly folding = new Folding(this);
  private minimap: Minimap;
  private sheets = new Sheets((only) => this.showOnly(only));
  private keyboard: Keyboard;
  private tools: Tools;
  private words = h("p", { class: "nothing", text: "chartNothing" });
  private first = button("chartFirst", () => void this.perform(() => this.begin()));
  private isShown = false;
  private current: Item | undefined;
  /** Where Tab leads. */
  private tabStop: Item | undefined;
  private queue: Promise<void> = Promise.resolve();

  constructor(
    readonly element: HTMLElement,
    core: Core,
    private editors: Editors,
    project: Project,
    header: Header,
    operands: Operands,
  ) {
    const module = new DrawingsModule<Questions>();
    this.document = new ChartDocument(module, editors, project);
    this.canvas = new Canvas({
      state: (item) => this.live.state(item),
      note: (item) => this.live.note(item),
      isCrossed: (item) => this.live.isCrossed(item),
      isSelected: (item) => this.isSelected(item),
      isCurrent: (item) => item === this.current,
      isPinned: ({ key }) => key === this.tabStop?.key,
    });
    this.live = new Live(core, this.document, operands, header);
    this.moments = new Moments(this.live, header);
    this.times = new Times(this.live, () => ({ only: this.only, file: this.document.file }));
    this.live.onChange(() => this.follow());
    this.field = new Field(this.canvas);
    this.pictures = new Pictures(this.canvas, () => ({
      drawn: this.document.drawn,
      only: this.only,
      file: this.document.file,
    }));
    this.commands = new Commands(this, core);
    this.find = new Find(this);
    this.minimap = new Minimap(this);
    this.stage = h("div", { class: "stage" }, this.canvas.element, this.minimap.element);
    this.tools = new Tools(this);
    this.keyboard = new Keyboard(this);
    new Pointer(this);
    new Handle(this);
    element.append(
      this.tools.element,
      this.find.element,
      this.moments.element,
      this.sheets.element,
      this.words,
      new SetReset(module, editors, project).element,
      this.first,
      this.stage,
      this.times.element,
    );
    this.document.onDrawn((drawn, before, find) => this.take(drawn, before, find));
    this.selection.onChange(() => this.selected());
    editors.onCursor(() => this.followCursor());
    onLanguage(() => this.draw());
    this.draw();
  }

  shown(isShown: boolean): void {
    this.isShown = isShown;
    this.live.shown(isShown);
    this.document.shown(isShown);
  }

  private take(drawn: Drawn | null, before: Drawn | null, find: Same): void {
    if (!before) this.only = null;
    else if (this.only !== null && !drawn?.sheet(this.only)) this.only = null;
    const hadFocus = this.hasFocus;
    this.draw();
    if (drawn && !before) this.canvas.begin();
    if (drawn && before) this.selection.follow(before, drawn, find);
    else this.selection.set(0, []);
    if (hadFocus && !this.field.isOpen) this.focus();
    this.followCursor();
  }

  /** Shows what the target does, or has done. */
  private follow(): void {
    this.stage.classList.toggle("past", this.live.trail.at !== null);
    this.canvas.later();
  }

  /** Draws all anew; nodes of what has not changed stay. */
  draw(): void {
    const { drawn } = this.document;
    const isEmpty = !drawn || drawn.isEmpty;
    this.stage.hidden = isEmpty;
    this.first.hidden = !this.document.canBegin;
    this.words.hidden = !isEmpty || this.document.canBegin;
    this.canvas.draw(drawn, this.only);
    this.sheets.show(drawn?.charts.sheets ?? [], this.only);
    this.minimap.draw();
    this.times.draw();
    this.tools.show();
    this.setTab();
  }

  /** Tab leads to what had the focus last, or to the first element. */
  private setTab(): void {
    const { drawn } = this.document;
    const { sheet, focus, action } = this.selection;
    for (const node of this.stage.querySelectorAll("[role=button][tabindex='0']"))
      node.setAttribute("tabindex", "-1");
    const item = (focus && drawn?.at(sheet, focus)) || drawn?.ofSheet(this.only ?? 0)[0];
    this.tabStop = item;
    if (item)
      this.canvas
        .shape(item)
        .target(item.id === focus ? action : null)
        .setAttribute("tabindex", "0");
  }

  /** What is selected in what is drawn, if that can be edited. */
  get scene(): Scene | null {
    const { drawn } = this.document;
    const { sheet, focus, action } = this.selection;
    if (!drawn) return null;
    const item = focus ? drawn.at(sheet, focus) : undefined;
    return { drawn, sheet, items: this.selection.items(drawn), focus: item ?? null, action };
  }

  get hasFocus(): boolean {
    return this.canvas.element.contains(document.activeElement);
  }

  private selected(): void {
    this.setTab();
    this.canvas.later();
    this.tools.show();
    const { focus } = this.scene ?? {};
    if (focus) this.document.mark(this.lineOf(focus));
  }

  private lineOf(item: Item): number {
    const { action } = this.selection;
    const written = item.kind === "step" && action !== null ? item.element.actions[action] : null;
    return (written ?? item.element).line;
  }

  isSelected({ sheet, id }: Item): boolean {
    return sheet === this.selection.sheet && this.selection.ids.includes(id);
  }

  /** Shows one of the charts, or all. */
  private showOnly(only: number | null): void {
    this.only = only;
    if (only !== null) this.folding.unfold(this.document.drawn?.sheet(only));
    const first = this.document.drawn?.ofSheet(only ?? this.selection.sheet)[0];
    if (only !== null && only !== this.selection.sheet && first) this.selection.only(first);
    this.draw();
  }

  reveal(item: Item): void {
    this.canvas.reveal(item.kind === "step" ? item.box : barFrame(item.element));
  }

  selectAll(): void {
    const sheet = this.only ?? this.selection.sheet;
    this.selection.add(this.document.drawn?.ofSheet(sheet) ?? []);
  }

  /** Whether a drag moves the ground, whatever is there. */
  get isPanning(): boolean {
    return this.keyboard.isSpace;
  }

  /** Gives the focus to what is selected, and scrolls there. */
  focus(isRevealed = true): void {
    const { focus, action } = this.scene ?? {};
    if (!focus) return this.canvas.element.focus({ preventScroll: true });
    const target = this.canvas.shape(focus).target(action ?? null);
    this.setTab();
    target.focus({ preventScroll: true });
    if (isRevealed) this.reveal(focus);
  }

  /** Marks the element with the text's cursor, and scrolls to it unless somebody works here. */
  private followCursor(): void {
    const { drawn, file } = this.document;
    const line = file === null ? null : this.editors.cursorLine(file);
    if (!this.isShown || line === null) return;
    const current = drawn?.atLine(line);
    if (current === this.current) return;
    this.current = current;
    if (current && !this.element.contains(document.activeElement)) this.reveal(current);
    this.canvas.later();
  }

  /** Does things one after the other; what is refused is told. */
  perform(act: () => void | Promise<void>): Promise<void> {
    this.queue = this.queue.then(act).catch(tellRefusal);
    return this.queue;
  }

  tell(refusal: string): void {
    notice(refusal, true);
  }

  /** Edits, and selects what is new. Elements are those of a reading of the text. */
  async change(sheet: number, edits: Edit[], reading = this.document.reading): Promise<void> {
    const ids = await this.document.edit(sheet, edits, reading);
    this.select(sheet, ids, actionOf(edits.at(-1)));
  }

  private select(sheet: number, ids: ElementId[], action: number | null): void {
    const known = ids.flatMap((id) => this.document.drawn?.at(sheet, id) ?? []);
    const focus = known.find(({ kind }) => kind === "step") ?? known[0];
    if (!focus) return;
    const count = focus.kind === "step" ? focus.element.actions.length : 0;
    const index = action === null || count === 0 ? null : Math.min(action, count - 1);
    const selected = known.map(({ id }) => id);
    this.selection.set(sheet, selected, focus.id, index);
  }

  private async begin(): Promise<void> {
    await this.change(0, [{ addStep: { at: null, isInitial: true } }]);
    this.focus();
  }

  /** Leads to the text of what has the focus. */
  goToText(): void {
    const { focus } = this.scene ?? {};
    if (focus) this.document.goTo(this.lineOf(focus));
  }

  /** Goes on after a field, with keys that were pressed meanwhile; not where it was left for another
   * place, which has the focus. */
  goOn(early: KeyboardEvent[], isLeft: boolean): void {
    if (isLeft) return;
    this.focus();
    for (const event of early) this.keyboard.pressed(event);
  }

  /** What was written while a field was being opened. */
  takeWritten(): string {
    return this.keyboard.takeWritten();
  }
}

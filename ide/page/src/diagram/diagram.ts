// Diagrams of blocks in the page: drawn from the text in the editor, with the values of the target,
// and changed by mouse, finger and keys. The text is all there is of them.
import type { Core } from "../core/core";
import type { Watching } from "../core/watching";
import type { Editors } from "../editor/editors";
import { Obstacle, zoomButtons } from "../drawings/parts";
import { ask } from "../page/dialog";
import { button, h, iconButton, say } from "../page/dom";
import type { Point } from "../page/ground";
import { tellsOfProgram, type Header } from "../page/header";
import { icon } from "../page/icons";
import { notice } from "../page/notices";
import type { Operands } from "../panels/operands";
import type { Project } from "../project/project";
import { DIAGRAM_WORDS } from "../text/diagram_words";
import { addWords, onLanguage, t } from "../text/language";
import { Details } from "./details";
import { Clipboard } from "./clipboard";
import { DiagramDocument } from "./document";
import { Edits, freePlace, idsOf } from "./edits";
import { pressed, type Acts } from "./keyboard";
import { Live } from "./live";
import { Palette } from "./palette";
import { Pointer } from "./pointer";
import type { DiagramEdit } from "./protocol";
import { Selection } from "./selection";
import { Sheets, type Item } from "./sheets";

addWords(DIAGRAM_WORDS);

/** What others do for diagrams. */
interface Helps {
  plot(operand: string): void;
  /** Asks for another name for what is at a place of a text; that name, or null. */
  rename(file: string, at: number): Promise<string | null>;
}

export class DiagramView {
  private document: DiagramDocument;
  private live: Live;
  private sheets: Sheets;
  private details: Details;
  private edits: Edits;
  private palette: Palette;
  private words = h("p", { class: "nothing", text: "diagramNothing" });
  private obstacle = new Obstacle((line) => this.document.goTo(line));
  private tools: HTMLElement;
  private stage: HTMLElement;
  private selection = new Selection();
  private clipboard: Clipboard;
  private isShown = false;

  constructor(
    element: HTMLElement,
    core: Core,
    private editors: Editors,
    project: Project,
    header: Header,
    operands: Operands,
    watching: Watching,
    private helps: Helps,
  ) {
    this.document = new DiagramDocument(editors, project);
    this.live = new Live(watching, operands, () => this.showValues());
    this.sheets = new Sheets(this.live, this.selection, () => this.refreshed());
    this.edits = new Edits(this.document, (keys) => this.chooseMade(keys));
    this.clipboard = new Clipboard({
      isHere: () => this.stage.contains(document.activeElement),
      remove: () => this.remove(),
      paste: (text) => void this.edits.paste(this.sheet, text),
    });
    this.palette = new Palette(({ name }) => this.add((at) => ({ call: { block: name, at } })));
    this.details = new Details(core, this.live, this.edits, helps.plot, (line) =>
      this.document.goTo(line),
    );
    this.tools = h(
      "div",
      { class: "tools", attributes: { role: "toolbar" }, label: "diagramTools" },
      button("diagramAddBlock", () => void this.openPalette()),
      button("diagramAddWritten", () => void this.write()),
      button("diagramGroup", () => void this.group()),
      button("diagramRename", () => void this.rename()),
      button("diagramRemove", () => this.remove()),
      iconButton(icon("undo"), "diagramUndo", () => this.document.goBack(true)),
      iconButton(icon("redo"), "diagramRedo", () => this.document.goBack(false)),
      ...zoomButtons(this.sheets),
    );
    this.stage = h("div", { class: "stage" }, this.sheets.element);
    const { palette, details } = this;
    element.append(this.tools, this.obstacle.element, this.words, palette.element, this.stage);
    element.append(details.element);
    this.document.onDrawn((isOther) => this.take(isOther));
    this.listen();
    core.on("program", () => this.want());
    editors.onCursor(() => this.followCursor());
    header.onStatus((status) => this.takeAlive(tellsOfProgram(status)));
    this.live.isAlive = header.status !== undefined && tellsOfProgram(header.status);
    onLanguage(() => this.draw());
    this.draw();
  }

  shown(isShown: boolean): void {
    this.isShown = isShown;
    this.document.shown(isShown);
    this.want();
  }

  private takeAlive(isAlive: boolean): void {
    if (isAlive === this.live.isAlive) return;
    this.live.isAlive = isAlive;
    this.want();
    this.showValues();
  }

  private take(isOther: boolean): void {
    if (isOther) this.selection.only(undefined);
    this.draw();
    if (isOther && this.document.drawn) this.sheets.begin();
    this.followCursor();
  }

  private draw(): void {
    const { drawn } = this.document;
    const hadFocus = this.stage.contains(document.activeElement);
    const isDrawn = drawn !== null && !drawn.obstacle;
    this.stage.hidden = this.tools.hidden = !isDrawn;
    if (!isDrawn) this.palette.show(null);
    const hasElements = drawn?.sheets.some(({ elements }) => elements.length > 0) ?? false;
    say(this.words, "text", isDrawn ? "diagramEmpty" : "diagramNothing");
    this.words.hidden = hasElements || Boolean(drawn?.obstacle);
    const { obstacle, mistake } = drawn ?? {};
    this.obstacle.show(obstacle ?? mistake?.message ?? "", mistake?.line);
    this.sheets.draw(drawn);
    this.details.offer(this.sheets.items);
    this.showChosen();
    this.want();
    const { focus } = this.selection;
    if (hadFocus && focus) this.sheets.shape(focus)?.button.focus();
  }

  /** Other nodes are there: marks what is chosen, and asks for other values. */
  private refreshed(): void {
    for (const item of this.sheets.items) {
      const shape = this.sheets.shape(item);
      if (!shape) continue;
      shape.button.setAttribute("tabindex", item === this.selection.focus ? "0" : "-1");
      shape.group.classList.toggle("selected", this.selection.has(item));
      shape.group.classList.toggle("current", item === this.current);
    }
    this.want();
  }

  private want(): void {
    const isWanted = this.isShown && this.live.isAlive;
    this.live.want(isWanted ? [...this.sheets.outputs(), ...this.details.named] : []);
  }

  private showValues(): void {
    this.sheets.showValues();
    this.details.showValues();
  }

  /** Other elements are chosen. */
  private selected(): void {
    this.showChosen();
    this.sheets.refresh();
  }

  /** Details are those of the element that keys go to; what is chosen can be copied. */
  private showChosen(): void {
    const { focus, chosen } = this.selection;
    this.details.show((focus && this.selection.has(focus) && focus) || null);
    const [first] = chosen;
    const text = first ? this.document.copy(first.sheet, idsOf(chosen)) : Promise.resolve("");
    void this.clipboard.prepare(text);
  }

  private choose(item: Item | undefined, isMore = false): void {
    if (isMore && item) this.selection.toggle(item);
    else this.selection.only(item);
    this.selected();
    if (!item) return;
    this.sheets.reveal(item.element.room);
    this.sheets.shape(item)?.button.focus({ preventScroll: true });
  }

  private current: Item | undefined;

  /** Marks the element with the text's cursor, and scrolls to it unless somebody works here. */
  private followCursor(): void {
    const { file } = this.document;
    const line = file === null ? null : this.editors.cursorLine(file);
    if (!this.isShown || line === null) return;
    const current = this.sheets.items.find(({ element }) => element.line === line);
    if (current === this.current) return;
    this.current = current;
    if (current && !this.stage.contains(document.activeElement))
      this.sheets.reveal(current.element.room);
    this.sheets.later();
  }

  private listen(): void {
    const { element } = this.sheets;
    const acts: Acts = {
      choose: (item, isMore) => this.choose(item, isMore),
      chooseAll: () =>
        this.chooseAll(this.sheets.items.filter(({ sheet }) => sheet === this.sheet)),
      goToText: (item) => this.document.goTo(item.element.line),
      move: (by) => void this.edits.move(this.selection.chosen, by),
      remove: () => this.remove(),
      group: () => void this.group(),
      rename: () => void this.rename(),
      goBack: (isUndo) => this.document.goBack(isUndo),
      addBlock: () => void this.openPalette(),
    };
    this.stage.addEventListener("keydown", (event) => {
      const group = this.sheets.groupAt(event.target);
      if (group.length > 0 && (event.key === "Enter" || event.key === " ")) {
        event.preventDefault();
        this.chooseTogether(group);
      } else if (pressed(event, this.sheets.items, this.selection.focus, acts))
        event.preventDefault();
    });
    element.addEventListener("click", (event) => {
      const group = this.sheets.groupAt(event.target);
      if (group.length > 0) this.chooseTogether(group);
      else
        this.choose(this.sheets.at(event.target), event.shiftKey || event.ctrlKey || event.metaKey);
    });
    element.addEventListener("dblclick", (event) => {
      const item = this.sheets.at(event.target);
      if (item) this.document.goTo(item.element.line);
    });
    new Pointer(this.sheets, this.edits, this.selection);
  }

  /** The diagram that is worked in. */
  private get sheet(): number {
    return this.selection.focus?.sheet ?? 0;
  }

  private remove(): void {
    void this.edits.remove(this.selection.chosen);
  }

  /** Asks for the group of what is chosen. */
  private async group(): Promise<void> {
    const { chosen } = this.selection;
    const [first] = chosen;
    if (!first) return notice(t("diagramChoose"));
    const title = t("diagramGroupTitle");
    const name = await ask(title, "diagramGroupName", first.group, "diagramGroupPut", false);
    if (name !== null) await this.edits.group(chosen, name);
  }

  /** Asks for another name of the element that keys go to. */
  private async rename(): Promise<void> {
    const { focus } = this.selection;
    const place = focus && this.selection.has(focus) && this.document.nameAt(focus.element);
    if (!place) return notice(t("diagramChoose"));
    const to = await this.helps.rename(place.file, place.at);
    if (to !== null) this.selection.renamed(focus, to);
  }

  private async openPalette(): Promise<void> {
    this.palette.show(await this.document.blocks());
  }

  /** Adds an element where there is room, to the diagram that is worked in. */
  private add(edit: (at: Point) => DiagramEdit): void {
    const at = freePlace(this.sheets.items, this.sheets.view());
    void this.edits.perform(this.sheet, edit(at));
  }

  private async write(): Promise<void> {
    const statement = await ask(t("diagramWritten"), "newValue", "", "diagramAdd");
    if (statement !== null) this.add((at) => ({ write: { statement, at } }));
  }

  private chooseAll(items: Item[]): void {
    this.selection.all(items);
    this.selected();
  }

  /** Chooses elements that are new. */
  private chooseMade(keys: string[]): void {
    this.chooseTogether(this.sheets.items.filter(({ key }) => keys.includes(key)));
  }

  private chooseTogether(items: Item[]): void {
    const [first] = items;
    if (!first) return;
    this.choose(first);
    this.chooseAll(items);
  }
}

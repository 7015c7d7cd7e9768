// Diagrams of blocks in the page: drawn from the text in the editor, with the values of the target,
// and changed by mouse, finger and keys. The text is all there is of them.
import type { Core } from "../core/core";
import type { Watching } from "../core/watching";
import type { Editors } from "../editor/editors";
import { ask } from "../page/dialog";
import { button, h, iconButton, say } from "../page/dom";
import type { Point } from "../page/ground";
import { tellsOfProgram, type Header } from "../page/header";
import { icon } from "../page/icons";
import type { Operands } from "../panels/operands";
import type { Project } from "../project/project";
import { DIAGRAM_WORDS } from "../text/diagram_words";
import { addWords, onLanguage, t } from "../text/language";
import { Details } from "./details";
import { DiagramDocument } from "./document";
import { Edits, freePlace } from "./edits";
import { pressed, type Acts } from "./keyboard";
import { Live } from "./live";
import { Palette } from "./palette";
import { Pointer } from "./pointer";
import type { DiagramEdit } from "./protocol";
import { Sheets, type Item } from "./sheets";

addWords(DIAGRAM_WORDS);

export class DiagramView {
  private document: DiagramDocument;
  private live: Live;
  private sheets: Sheets;
  private details: Details;
  private edits: Edits;
  private palette: Palette;
  private words = h("p", { class: "nothing", text: "diagramNothing" });
  private obstacle = h("p", { class: "obstacle", attributes: { role: "status" } });
  private tools: HTMLElement;
  private stage: HTMLElement;
  /** The element that Tab leads to, and whose details are shown once it was chosen. */
  private focus: Item | undefined;
  private isChosen = false;
  private isShown = false;

  constructor(
    element: HTMLElement,
    core: Core,
    private editors: Editors,
    project: Project,
    header: Header,
    operands: Operands,
    watching: Watching,
    plot: (operand: string) => void,
  ) {
    this.document = new DiagramDocument(editors, project);
    this.live = new Live(watching, operands, () => this.showValues());
    this.sheets = new Sheets(
      this.live,
      () => this.focus,
      () => this.refreshed(),
    );
    this.edits = new Edits(this.document, (key) => this.chooseMade(key));
    this.palette = new Palette(({ name }) => this.add((at) => ({ call: { block: name, at } })));
    this.details = new Details(core, this.live, this.edits, plot, (line) =>
      this.document.goTo(line),
    );
    this.tools = h(
      "div",
      { class: "tools", attributes: { role: "toolbar" }, label: "diagramTools" },
      button("diagramAddBlock", () => void this.openPalette()),
      button("diagramAddWritten", () => void this.write()),
      button("diagramRemove", () => this.remove()),
      iconButton(icon("undo"), "diagramUndo", () => this.document.goBack(true)),
      iconButton(icon("redo"), "diagramRedo", () => this.document.goBack(false)),
      iconButton(icon("smaller"), "diagramSmaller", () => this.sheets.zoomBy(-1)),
      iconButton(icon("add"), "diagramLarger", () => this.sheets.zoomBy(1)),
      iconButton(icon("fit"), "diagramFit", () => this.sheets.fit()),
    );
    this.stage = h("div", { class: "stage" }, this.sheets.element);
    const { palette, details } = this;
    element.append(this.tools, this.obstacle, this.words, palette.element, this.stage);
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
    if (isOther) this.isChosen = false;
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
    this.obstacle.hidden = !drawn?.obstacle && !drawn?.mistake;
    this.showObstacle();
    const key = this.focus?.key;
    this.focus = undefined;
    this.sheets.draw(drawn);
    const { items } = this.sheets;
    this.details.offer(items);
    this.focus = items.find((item) => item.key === key);
    this.isChosen &&= this.focus !== undefined;
    this.focus ??= items[0];
    this.sheets.refresh();
    this.showDetails();
    if (hadFocus && this.focus) this.sheets.shape(this.focus)?.button.focus();
  }

  private showObstacle(): void {
    const { obstacle, mistake } = this.document.drawn ?? {};
    const words = obstacle ?? mistake?.message ?? "";
    const go = mistake && button("showPlace", () => this.document.goTo(mistake.line));
    this.obstacle.replaceChildren(h("span", {}, words), ...(go ? [go] : []));
  }

  /** Other nodes are there: marks what is chosen, and asks for other values. */
  private refreshed(): void {
    for (const item of this.sheets.items) {
      const shape = this.sheets.shape(item);
      if (!shape) continue;
      shape.button.setAttribute("tabindex", item === this.focus ? "0" : "-1");
      shape.group.classList.toggle("selected", this.isChosen && item === this.focus);
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

  private showDetails(): void {
    this.details.show((this.isChosen && this.focus) || null);
    this.want();
  }

  private choose(item: Item | undefined): void {
    this.isChosen = item !== undefined;
    this.focus = item ?? this.focus;
    this.sheets.refresh();
    this.showDetails();
    if (!item) return;
    this.sheets.reveal(item.element.room);
    this.sheets.shape(item)?.button.focus({ preventScroll: true });
  }

  private current: Item | undefined;

  /** Marks the element with the text's cursor, and scrolls to it unless somebody works here. */
  private followCursor(): void {
    const { file } = this.document;
    if (!this.isShown || file === null || file !== this.editors.current) return;
    const { state } = this.editors.view;
    const line = state.doc.lineAt(state.selection.main.head).number;
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
      choose: (item) => this.choose(item),
      goToText: (item) => this.document.goTo(item.element.line),
      move: (item, by) => void (this.isChosen && this.edits.move(item, by)),
      remove: () => this.remove(),
      goBack: (isUndo) => this.document.goBack(isUndo),
      addBlock: () => void this.openPalette(),
    };
    this.stage.addEventListener("keydown", (event) => {
      if (pressed(event, this.sheets.items, this.focus, acts)) event.preventDefault();
    });
    element.addEventListener("click", (event) => this.choose(this.sheets.at(event.target)));
    element.addEventListener("dblclick", (event) => {
      const item = this.sheets.at(event.target);
      if (item) this.document.goTo(item.element.line);
    });
    new Pointer(this.sheets, this.edits);
  }

  private remove(): void {
    if (this.isChosen && this.focus) void this.edits.remove(this.focus);
  }

  private async openPalette(): Promise<void> {
    this.palette.show(await this.document.blocks());
  }

  /** Adds an element where there is room, to the diagram that is worked in. */
  private add(edit: (at: Point) => DiagramEdit): void {
    const sheet = this.focus?.sheet ?? 0;
    void this.edits.perform(sheet, edit(freePlace(this.sheets.items, this.sheets.view())));
  }

  private async write(): Promise<void> {
    const statement = await ask(t("diagramWritten"), "newValue", "", "diagramAdd");
    if (statement !== null) this.add((at) => ({ write: { statement, at } }));
  }

  /** Chooses an element that is new. */
  private chooseMade(key: string): void {
    const item = this.sheets.items.find((one) => one.key === key);
    if (item) this.choose(item);
  }
}

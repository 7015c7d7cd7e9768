// Diagrams of blocks in the page: drawn from the text in the editor, with the values of the target.
// The text is all there is of them, and is changed in the editor.
import type { Core } from "../core/core";
import type { Watching } from "../core/watching";
import type { Editors } from "../editor/editors";
import { button, h, iconButton } from "../page/dom";
import { tellsOfProgram, type Header } from "../page/header";
import { icon } from "../page/icons";
import type { Operands } from "../panels/operands";
import type { Project } from "../project/project";
import { DIAGRAM_WORDS } from "../text/diagram_words";
import { addWords, onLanguage } from "../text/language";
import { Details } from "./details";
import { DiagramDocument } from "./document";
import { Live } from "./live";
import { Sheets, type Item } from "./sheets";

addWords(DIAGRAM_WORDS);

/** A drag is farther than this, in pixels. */
const FAR = 4;

export class DiagramView {
  private document: DiagramDocument;
  private live: Live;
  private sheets: Sheets;
  private details: Details;
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
    this.details = new Details(core, this.live, plot, (line) => this.document.goTo(line));
    this.tools = h(
      "div",
      { class: "tools", attributes: { role: "toolbar" }, label: "diagramTools" },
      iconButton(icon("smaller"), "diagramSmaller", () => this.sheets.zoomBy(-1)),
      iconButton(icon("add"), "diagramLarger", () => this.sheets.zoomBy(1)),
      iconButton(icon("fit"), "diagramFit", () => this.sheets.fit()),
    );
    this.stage = h("div", { class: "stage" }, this.sheets.element);
    element.append(this.tools, this.obstacle, this.words, this.stage, this.details.element);
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
    const isEmpty = !drawn || drawn.sheets.length === 0;
    this.stage.hidden = this.tools.hidden = isEmpty;
    this.words.hidden = drawn !== null;
    this.obstacle.hidden = !drawn?.obstacle && !drawn?.mistake;
    this.showObstacle();
    const key = this.focus?.key;
    this.focus = undefined;
    this.sheets.draw(drawn);
    const { items } = this.sheets;
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
    element.addEventListener("keydown", (event) => this.pressed(event));
    element.addEventListener("click", (event) => this.choose(this.sheets.at(event.target)));
    element.addEventListener("dblclick", (event) => {
      const item = this.sheets.at(event.target);
      if (item) this.document.goTo(item.element.line);
    });
    element.addEventListener("pointerdown", (event) => this.drag(event));
  }

  /** Keys: arrows go along the order of execution, Enter chooses, F12 leads to the text. */
  private pressed(event: KeyboardEvent): void {
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    const inOrder = this.sheets.items.toSorted(
      (one, other) => one.sheet - other.sheet || one.element.order - other.element.order,
    );
    const at = inOrder.findIndex((item) => item === this.focus);
    const goals: Record<string, number> = {
      ArrowRight: at + 1,
      ArrowDown: at + 1,
      ArrowLeft: at - 1,
      ArrowUp: at - 1,
      Home: 0,
      End: inOrder.length - 1,
    };
    const goal = goals[event.key];
    if (goal !== undefined) this.choose(inOrder[goal] ?? this.focus);
    else if (event.key === "Enter" || event.key === " ") this.choose(this.focus);
    else if (event.key === "Escape") this.choose(undefined);
    else if (event.key === "F12" && this.focus) this.document.goTo(this.focus.element.line);
    else return;
    event.preventDefault();
  }

  /** A mouse moves the ground; a finger does it by itself. */
  private drag(down: PointerEvent): void {
    if (down.pointerType === "touch" || down.button > 1) return;
    const { element } = this.sheets;
    const [left, top] = [element.scrollLeft, element.scrollTop];
    const move = (event: PointerEvent) => {
      const [x, y] = [event.clientX - down.clientX, event.clientY - down.clientY];
      if (Math.hypot(x, y) > FAR) element.scrollTo(left - x, top - y);
    };
    const end = () => element.removeEventListener("pointermove", move);
    element.addEventListener("pointermove", move);
    for (const kind of ["pointerup", "pointercancel", "pointerleave"] as const)
      element.addEventListener(kind, end, { once: true });
  }
}

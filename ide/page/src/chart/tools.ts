// The buttons over a drawing, with the menus of what can be done.
import { button, h, iconButton, say } from "../page/dom";
import { icon, type Icon } from "../page/icons";
import { openMenu, type MenuGroups, type MenuItem } from "../page/menu";
import { t, type Key } from "../text/language";
import { SAID, type CommandName } from "./commands";
import type { ChartEditor } from "./editor";

const INSERT: CommandName[][] = [
  ["after", "before", "parallel", "alternative", "alone"],
  ["connect", "connectTo"],
  ["action"],
];
const CHANGE: CommandName[][] = [
  ["write", "title", "priority", "comment", "initial", "actionUp", "actionDown", "erase"],
  ["copy", "cut", "paste", "duplicate", "all"],
  ["alignLeft", "alignTop", "layout"],
  ["goToText"],
];
const FOLLOW: CommandName[][] = [
  ["activate"],
  ["momentBack", "momentForward", "momentNow", "oneScan"],
  ["times", "timesSvg", "timesPng"],
];
const VIEW: CommandName[][] = [
  ["find", "blocks", "fold", "foldAll"],
  ["svg", "png", "print"],
];
/** Those that have buttons of their own. */
const BUTTONS: [CommandName, Icon][] = [
  ["after", "stepAfter"],
  ["undo", "undo"],
  ["redo", "redo"],
  ["smaller", "smaller"],
  ["larger", "add"],
  ["fit", "fit"],
];

export class Tools {
  readonly element: HTMLElement;
  private buttons = new Map<CommandName, HTMLButtonElement>();
  private mistake = button("chartToMistake", () => this.goToMistake(), { class: "link" });
  private obstacle = h("p", { class: "obstacle" });

  constructor(private editor: ChartEditor) {
    const tools = h(
      "div",
      { class: "tools", attributes: { role: "toolbar" }, label: "chartTools" },
      this.menu("chartInsert", () => INSERT),
      this.menu("chartChange", () => CHANGE),
      this.menu("chartFollow", () => FOLLOW),
      this.menu("chartView", () => VIEW),
      ...BUTTONS.map(([name, picture]) => this.button(name, picture)),
    );
    this.element = h("div", { class: "chart-head" }, tools, this.obstacle);
    editor.commands.onChange(() => this.show());
    editor.canvas.element.addEventListener("contextmenu", (event) => this.context(event));
  }

  private button(name: CommandName, picture: Icon): HTMLButtonElement {
    const act = () => void this.editor.commands.run(name);
    const made = iconButton(icon(picture), SAID[name].text, act);
    this.buttons.set(name, made);
    return made;
  }

  private menu(text: Key, groups: () => CommandName[][]): HTMLButtonElement {
    const made = button(text, () => openMenu(made, this.items(groups())));
    made.setAttribute("aria-haspopup", "menu");
    made.setAttribute("aria-expanded", "false");
    return made;
  }

  private items(groups: CommandName[][]): MenuGroups {
    return groups.map((names) => names.map((name) => this.item(name)));
  }

  private item(name: CommandName): MenuItem {
    const { commands } = this.editor;
    const { text, keys } = SAID[name];
    const why = commands.why(name);
    const checked = this.checked(name);
    return {
      text: t(text),
      act: () => void commands.run(name),
      ...(keys[0] ? { hint: keys[0] } : {}),
      ...(why === null ? {} : { why }),
      ...(checked === undefined ? {} : { checked }),
    };
  }

  /** Of what is shown or not, whether it is. */
  private checked(name: CommandName): boolean | undefined {
    const { canvas, folding, times } = this.editor;
    if (name === "blocks") return canvas.hasBlocks;
    if (name === "foldAll") return folding.areAllShown;
    return name === "times" ? times.isOpen : undefined;
  }

  /** The menu of what is under the pointer, or has the focus. */
  private context(event: MouseEvent): void {
    const { editor } = this;
    if (editor.field.isOpen) return;
    event.preventDefault();
    const spot = editor.canvas.at(event.target);
    if (spot && !editor.isSelected(spot.item)) editor.selection.only(spot.item, spot.action);
    const at = spot ? editor.canvas.shape(spot.item).target(spot.action) : editor.canvas.element;
    editor.focus(false);
    openMenu(at, this.items([["activate", "fold"], ...INSERT, ...CHANGE]));
  }

  /** What can be done, and what is wrong with the text. */
  show(): void {
    const { editor } = this;
    const { drawn } = editor.document;
    this.element.hidden = !drawn || (drawn.isEmpty && drawn.isEditable);
    for (const [name, made] of this.buttons) {
      const why = editor.commands.why(name);
      made.setAttribute("aria-disabled", String(why !== null));
      if (why === null) say(made, "title", SAID[name].text);
      else made.title = why;
    }
    const { mistake, obstacle } = drawn?.charts ?? { mistake: null, obstacle: null };
    this.obstacle.hidden = !mistake && obstacle === null;
    if (mistake) {
      say(
        this.mistake.querySelector("span") ?? this.mistake,
        "text",
        "chartToMistake",
        mistake.line,
      );
      this.obstacle.replaceChildren(this.mistake, mistake.message);
    } else this.obstacle.replaceChildren(obstacle ?? "");
  }

  private goToMistake(): void {
    const { mistake } = this.editor.document.drawn?.charts ?? {};
    if (mistake) this.editor.document.goTo(mistake.line);
  }
}

// Finds steps and transitions by what is written at them.
import { button, h, iconButton, say } from "../page/dom";
import { icon } from "../page/icons";
import type { Item } from "./drawn";
import type { ChartEditor } from "./editor";

export class Find {
  private count = h("span", { class: "hint", attributes: { role: "status" } });
  private input = h("input", {
    label: "chartFindWhat",
    placeholder: "chartFindWhat",
    attributes: { type: "search", autocomplete: "off", spellcheck: "false" },
    on: { input: () => this.go(0), keydown: (event) => this.keys(event) },
  });
  readonly element = h(
    "div",
    { class: "line-form", set: { hidden: true } },
    this.input,
    button("chartFindNext", () => this.go(1)),
    this.count,
    iconButton(icon("close"), "chartFindEnd", () => this.close()),
  );

  constructor(private editor: ChartEditor) {}

  /** Opens it; `written` was written while it was not there yet. */
  open(written: string): void {
    this.element.hidden = false;
    this.input.focus();
    this.input.select();
    if (written === "") return;
    this.input.value = written.trimEnd();
    this.go(0);
  }

  private close(): void {
    this.element.hidden = true;
    this.editor.focus();
  }

  private keys(event: KeyboardEvent): void {
    if (event.key === "Enter") this.go(event.shiftKey ? -1 : 1);
    else if (event.key === "Escape") this.close();
    else return;
    event.preventDefault();
  }

  private found(): Item[] {
    const wanted = this.input.value.trim().toLowerCase();
    if (wanted === "") return [];
    const { scene, only } = this.editor;
    const isIn = (item: Item) =>
      (only ?? item.sheet) === item.sheet && wordsOf(item).toLowerCase().includes(wanted);
    return (scene?.drawn.items ?? []).filter(isIn);
  }

  private isNamed({ kind, element }: Item): boolean {
    const name = kind === "step" ? element.fullName : element.title;
    return name.toLowerCase() === this.input.value.trim().toLowerCase();
  }

  /** Selects what is called so, or the first one from what is selected on; the next one, or the one
   * before. */
  private go(step: 0 | 1 | -1): void {
    const found = this.found();
    const { focus } = this.editor.scene ?? {};
    const at = focus ? found.findIndex(({ key }) => key === focus.key) : -1;
    const named = step === 0 ? found.findIndex((item) => this.isNamed(item)) : -1;
    const from = named < 0 ? at + step : named;
    const next = at < 0 && named < 0 ? 0 : (from + found.length) % found.length;
    const item = found[next];
    if (item) {
      this.editor.selection.only(item);
      this.editor.reveal(item);
    }
    if (this.input.value.trim() === "") this.count.textContent = "";
    else say(this.count, "text", "chartFound", item ? next + 1 : 0, found.length);
  }
}

function wordsOf(item: Item): string {
  if (item.kind === "transition")
    return [item.element.title, item.element.condition, item.element.comment].join("\n");
  const actions = item.element.actions.map(({ qualifier, name }) => `${qualifier} ${name}`);
  return [item.element.fullName, item.element.comment, ...actions].join("\n");
}

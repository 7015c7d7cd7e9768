// The blocks that can be put into a diagram, to be searched and chosen.
import { button, h } from "../page/dom";
import { t } from "../text/language";
import type { Block } from "./protocol";

export class Palette {
  readonly element: HTMLElement;
  private search = h("input", {
    label: "diagramSearch",
    placeholder: "diagramSearch",
    attributes: { type: "search", autocomplete: "off", spellcheck: "false" },
  });
  private list = h("ul", { class: "list" });
  private none = h("p", { class: "hint", text: "diagramNoBlock" });
  private blocks: Block[] = [];

  constructor(private chosen: (block: Block) => void) {
    this.search.addEventListener("input", () => this.draw());
    this.search.addEventListener("keydown", (event) => this.pressed(event));
    this.element = h(
      "section",
      { class: "palette", label: "diagramBlocks", attributes: { hidden: true } },
      h("div", { class: "controls" }, this.search, this.closing()),
      this.none,
      this.list,
    );
  }

  private closing(): HTMLElement {
    return button("diagramClose", () => this.show(null), { class: "small" });
  }

  /** Shows these blocks, or nothing. */
  show(blocks: Block[] | null): void {
    this.element.hidden = blocks === null;
    if (!blocks) return;
    this.blocks = blocks;
    this.search.value = "";
    this.draw();
    this.search.focus();
  }

  private draw(): void {
    const wanted = this.search.value.trim().toLowerCase();
    const fits = ({ name, summary }: Block) => `${name} ${summary}`.toLowerCase().includes(wanted);
    const isFirst = ({ name }: Block) => name.toLowerCase().startsWith(wanted);
    const found = this.blocks.filter(fits);
    const sorted = [...found.filter(isFirst), ...found.filter((block) => !isFirst(block))];
    this.none.hidden = sorted.length > 0;
    this.list.replaceChildren(...sorted.map((block) => h("li", {}, this.entry(block))));
  }

  private entry(block: Block): HTMLElement {
    const { name, summary, inputs, outputs } = block;
    const title = t("diagramPins", inputs.join(", "), outputs.join(", "));
    return h(
      "button",
      {
        class: "row",
        attributes: { type: "button", title },
        on: { click: () => this.chosen(block) },
      },
      h("b", {}, name),
      h("span", { class: "hint" }, summary),
    );
  }

  /** Enter takes the first one, Escape goes away. */
  private pressed(event: KeyboardEvent): void {
    const first = this.list.querySelector("button");
    if (event.key === "Escape") this.show(null);
    else if (event.key === "Enter") first?.click();
    else if (event.key === "ArrowDown") first?.focus();
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
}

// The plant that is wired to the simulator, and the board.
import type { Core } from "../core/core";
import type { Pins } from "../core/protocol";
import { button, h, select } from "../page/dom";
import { Board } from "../plants/board";
import { PICTURES } from "../plants/all";
import type { Drawing, Picture } from "../plants/picture";
import type { Project } from "../project/project";
import type { Key } from "../text/language";
import { labelled } from "./scope";

const NEWS_MAX = 100;
const NO_PLANT = "";

export class Plant {
  readonly element: HTMLElement;
  private board: Board;
  private choice: HTMLSelectElement;
  private options: HTMLInputElement;
  private place = h("div", { class: "plant-place" });
  private lines = h("ol");
  private news = h(
    "div",
    { class: "news", label: "plantNews", attributes: { role: "log", tabindex: 0 } },
    this.lines,
  );
  private drawing: Drawing | undefined;
  private picture: Picture | undefined;
  private spec: string | null = null;
  private pins: Pins = { inputs: 0, outputs: 0, analog: [], pwm: [] };

  constructor(
    private core: Core,
    private project: Project,
  ) {
    this.board = new Board(core);
    const names: [string, Key][] = PICTURES.map(({ name, title }) => [name, title]);
    this.choice = select("plantChoice", [[NO_PLANT, "noPlant"], ...names], NO_PLANT, () =>
      this.chosen(),
    );
    this.options = h("input", {
      label: "plantOptions",
      placeholder: "plantOptions",
      attributes: { autocomplete: "off", spellcheck: "false" },
      on: { change: () => this.chosen() },
    });
    const controls = h(
      "div",
      { class: "controls" },
      labelled("plantChoice", this.choice),
      this.options,
      button("beginAnew", () => this.chosen()),
    );
    this.element = h("div", {}, controls, this.place, this.news, this.board.element);
    project.onOpened(() => this.begin(project.plant));
    core.on("plant", ({ name, state, news }) => {
      if (name === this.picture?.name) this.drawing?.show(new Map(state), this.pins);
      this.tell(news);
    });
    core.on("pins", (pins) => {
      this.pins = pins;
      this.board.show(pins);
    });
    this.begin(null);
  }

  /** Another plant was chosen here. */
  private chosen(): void {
    const name = this.choice.value;
    const spec = name === NO_PLANT ? null : `${name} ${this.options.value}`.trim();
    this.project.setPlant(spec);
    this.begin(spec);
  }

  /** A plant begins anew, or none. */
  private begin(spec: string | null): void {
    const isOther = spec?.split(" ")[0] !== this.spec?.split(" ")[0] || !this.drawing;
    this.spec = spec;
    this.core.tell({ do: "plant", spec });
    const [name = "", ...options] = (spec ?? "").split(" ");
    this.picture = PICTURES.find((picture) => picture.name === name);
    this.choice.value = this.picture ? name : NO_PLANT;
    this.options.value = options.join(" ");
    this.options.hidden = spec === null;
    this.lines.replaceChildren();
    this.news.hidden = true;
    this.board.setDriven(this.picture?.drives(spec ?? "") ?? { digital: 0, analog: 0 });
    if (!isOther) return;
    this.drawing = this.picture?.draw();
    this.drawing?.show(new Map(), this.pins);
    this.place.replaceChildren(...(this.drawing ? [this.drawing.element] : []));
  }

  private tell(news: string[]): void {
    if (news.length === 0) return;
    this.news.hidden = false;
    const isAtEnd = this.news.scrollTop + this.news.clientHeight >= this.news.scrollHeight - 8;
    this.lines.append(...news.map((line) => h("li", {}, line)));
    while (this.lines.childElementCount > NEWS_MAX) this.lines.firstElementChild?.remove();
    if (isAtEnd) this.news.scrollTop = this.news.scrollHeight;
  }
}

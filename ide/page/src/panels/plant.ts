// The plant that is wired to the simulator, and the board.
import { Refusal, type Core } from "../core/core";
import type { Pins, PlantInfo } from "../core/protocol";
import { button, h, select } from "../page/dom";
import { Board } from "../plants/board";
import { Controls } from "../plants/controls";
import { Described } from "../plants/described";
import { PICTURES } from "../plants/all";
import type { Drawing } from "../plants/picture";
import type { Project } from "../project/project";
import { onLanguage, t } from "../text/language";
import { labelled } from "./scope";

const NEWS_MAX = 100;
const NO_PLANT = "";
/** So long after a letter in its file the plant is looked at again. */
const EDITED_MS = 500;
const NO_INFO: PlantInfo = {
  title: ["", "", ""],
  digital: 0,
  analog: 0,
  controls: [],
  shapes: [],
};

export class Plant {
  readonly element: HTMLElement;
  private board: Board;
  private controls: Controls;
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
  private spec: string | null = null;
  private pins: Pins = { inputs: 0, outputs: 0, analog: [], pwm: [] };
  private timer = 0;
  /** Answers to questions about other plants than the last one are too late. */
  private asked = 0;

  constructor(
    private core: Core,
    private project: Project,
  ) {
    this.board = new Board(core);
    this.controls = new Controls(core);
    this.choice = select("plantChoice", [], NO_PLANT, () => this.chosen());
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
    this.element = h(
      "div",
      {},
      controls,
      this.place,
      this.controls.element,
      this.news,
      this.board.element,
    );
    project.onOpened(() => this.begin(project.plant));
    project.onFiles(() => this.offer());
    project.onEdited((file) => this.edited(file));
    core.on("plant", ({ name, state, places, news }) => {
      if (name === this.name()) this.drawing?.show(new Map(state), this.pins, places);
      this.tell(news);
    });
    core.on("pins", (pins) => {
      this.pins = pins;
      this.board.show(pins);
    });
    core.on("status", ({ status }) => {
      // What is off shows nothing of what it was.
      if (status.mode === "OFFLINE") this.board.show({ ...this.pins, inputs: 0, outputs: 0 });
    });
    onLanguage(() => {
      this.offer();
      this.controls.relabel();
      this.drawing?.relabel?.();
    });
    this.begin(null);
  }

  /** The name of the plant, or of its file; without options. */
  private name(): string {
    if (this.spec === null) return NO_PLANT;
    return isFile(this.spec) ? this.spec : (this.spec.split(" ")[0] ?? NO_PLANT);
  }

  /** The plants that there are: pictures of the page, and files of the project. */
  private offer(): void {
    const options: [string, string][] = [
      [NO_PLANT, t("noPlant")],
      ...PICTURES.map(({ name, title }): [string, string] => [name, t(title)]),
      ...this.project
        .names()
        .filter(isFile)
        .map((file): [string, string] => [file, file]),
    ];
    const offered = options.map(([value, text]) => h("option", { set: { value } }, text));
    this.choice.replaceChildren(...offered);
    this.choice.value = this.name();
  }

  /** Another plant was chosen here. */
  private chosen(): void {
    const name = this.choice.value;
    const options = isFile(name) ? "" : this.options.value;
    const spec = name === NO_PLANT ? null : `${name} ${options}`.trim();
    this.project.setPlant(spec);
    this.begin(spec);
  }

  /** A plant begins anew, or none. */
  private begin(spec: string | null): void {
    this.spec = spec;
    this.core.tell({ do: "plant", spec });
    this.offer();
    const [, ...options] = (spec ?? "").split(" ");
    this.options.value = this.isOfFile() ? "" : options.join(" ");
    this.options.hidden = spec === null || this.isOfFile();
    this.lines.replaceChildren();
    this.news.hidden = true;
    void this.show(spec);
  }

  private isOfFile(): boolean {
    return this.spec !== null && isFile(this.spec);
  }

  /** Draws the plant, and what can be set in it. */
  private async show(spec: string | null): Promise<void> {
    const asked = ++this.asked;
    let info = NO_INFO;
    let refused = "";
    try {
      if (spec !== null) info = await this.core.ask({ do: "aboutPlant", spec });
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      refused = error.message;
    }
    if (asked !== this.asked) return;
    const picture = PICTURES.find(({ name }) => name === this.name());
    const isDescribed = this.isOfFile() && refused === "";
    this.drawing = isDescribed ? new Described(info) : picture?.draw();
    this.drawing?.show(new Map(), this.pins, []);
    const why = refused && h("p", { class: "refused" }, refused);
    this.place.replaceChildren(...[this.drawing?.element, why].filter((one) => !!one));
    this.controls.show(info.controls);
    this.board.setDriven(info);
  }

  /** Whoever writes the file of the plant sees what becomes of it, as soon as it has no errors. */
  private edited(file: string): void {
    if (file !== this.spec) return;
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.renew(file), EDITED_MS);
  }

  private async renew(spec: string): Promise<void> {
    try {
      await this.core.ask({ do: "aboutPlant", spec });
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      return;
    }
    if (spec === this.spec) this.begin(spec);
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

/** Whether a plant is described by a file. */
function isFile(name: string): boolean {
  return /\.plant$/i.test(name);
}

// The network with the cursor as a ladder, with its power flow. To be read: it is written as text.
import type { Core } from "../core/core";
import type {
  Ladder as Network,
  LadderPin,
  LadderRung,
  Line,
  Power,
  Value,
} from "../core/protocol";
import type { Editors } from "../editor/editors";
import { Rung } from "../ladder/rung";
import type { Shape } from "../ladder/shapes";
import { button, h } from "../page/dom";
import { tellsOfProgram, type Header } from "../page/header";
import { valuesMenu } from "../page/values";
import { Walk } from "../page/walk";
import type { Project } from "../project/project";
import { onLanguage, t, type Key } from "../text/language";

/** So long nothing is asked for while the cursor moves on. */
const QUIET_MS = 60;

const OBSTACLES: Record<string, Key> = {
  operand: "ladderOperand",
  noValue: "ladderNoValue",
  leavesRail: "ladderLeavesRail",
  part: "ladderPart",
  eno: "ladderEno",
  inputGoesOn: "ladderInputGoesOn",
  loop: "ladderLoop",
  stack: "ladderStack",
  tooDeep: "ladderTooDeep",
  tooLarge: "ladderTooLarge",
};

export class Ladder {
  readonly element: HTMLElement;
  private title = h("h2");
  private place = h("div", { class: "rungs" });
  private walk: Walk<Shape>;
  private isShown = false;
  private timer = 0;
  private network: Network | null = null;
  private drawn = "";
  private rungs: (Rung | null)[] = [];
  /** Of which file the values are. */
  private file = "";
  private lines = new Map<number, Line>();
  /** Power flow, and of which ladder. */
  private power: { id: number; rungs: Power[] } = { id: 0, rungs: [] };
  private listeners: (() => void)[] = [];

  constructor(
    private core: Core,
    private editors: Editors,
    project: Project,
    header: Header,
  ) {
    this.element = h("div", { class: "ladder" }, this.title, this.place);
    this.walk = new Walk(this.element, () => this.shapes());
    this.element.addEventListener("keydown", (event) => this.keys(event));
    this.element.addEventListener("click", (event) => this.clicked(event));
    editors.onCursor(() => this.soon());
    editors.onCurrent(() => this.soon());
    project.onFiles(() => this.soon());
    core.on("problems", () => this.soon());
    core.on("live", ({ file, lines }) => {
      this.file = file;
      this.lines = new Map(lines.map((line) => [line.line, line]));
      this.show();
    });
    core.on("power", ({ id, rungs }) => {
      this.power = { id, rungs };
      this.show();
    });
    header.onStatus((status) => {
      if (tellsOfProgram(status)) return;
      if (this.lines.size === 0 && this.power.rungs.length === 0) return;
      [this.lines, this.power] = [new Map(), { id: 0, rungs: [] }];
      this.show();
    });
    onLanguage(() => this.draw());
    this.draw();
  }

  /** The network is asked for only while it can be seen. */
  shown(isShown: boolean): void {
    this.isShown = isShown;
    if (isShown) this.soon();
    this.changed();
  }

  /** The network whose values are needed. */
  needed(): Network | null {
    return this.isShown ? this.network : null;
  }

  /** Is told when other lines are needed. */
  onNeeded(listener: () => void): void {
    this.listeners.push(listener);
  }

  private changed(): void {
    for (const listener of this.listeners) listener();
  }

  private soon(): void {
    clearTimeout(this.timer);
    if (this.isShown) this.timer = window.setTimeout(() => void this.ask(), QUIET_MS);
  }

  private async ask(): Promise<void> {
    const file = this.editors.current;
    const at = this.editors.view.state.selection.main.head;
    const network =
      file === null ? null : await this.core.ask({ do: "ladder", file, at }).catch(() => null);
    if (file !== this.editors.current) return;
    this.network = network;
    const drawn = JSON.stringify({ ...network, id: 0 });
    if (drawn !== this.drawn) {
      this.drawn = drawn;
      this.draw();
      this.changed();
    }
    this.mark();
  }

  private draw(): void {
    const { network } = this;
    const known = network?.number ?? null;
    const name = known === null ? t("ladderRungs") : `NETWORK ${known}`;
    this.title.textContent = network ? [name, network.title].filter(Boolean).join(" · ") : "";
    this.title.hidden = !network;
    if (!network) {
      this.rungs = [];
      this.place.replaceChildren(h("p", { class: "nothing", text: "ladderNothing" }));
      return;
    }
    this.rungs = network.rungs.map((rung) => (rung.obstacle ? null : new Rung(rung)));
    const parts = network.rungs.map((rung, index) => this.rungs[index]?.element ?? this.no(rung));
    const last = network.first + network.rungs.length - 1;
    const part =
      network.count > network.rungs.length &&
      h("p", { class: "part" }, t("ladderPartOf", network.first, last, network.count));
    this.place.replaceChildren(...(part ? [part] : []), ...parts);
    this.show();
    this.walk.begin();
  }

  /** Why a rung is not drawn. */
  private no({ obstacle }: LadderRung): HTMLElement {
    const { why, line, message } = obstacle ?? { why: "", line: 0, message: "" };
    const key = OBSTACLES[why];
    return h(
      "p",
      { class: "obstacle" },
      h("span", {}, `${t("network", line)}: ${key ? t(key) : message} `),
      button("showPlace", () => this.goTo(line)),
    );
  }

  private show(): void {
    const isThis = this.network?.file === this.file;
    const lines: ReadonlyMap<number, Line> = isThis ? this.lines : new Map();
    const { id, rungs } = this.power;
    const power = id === this.network?.id ? rungs : [];
    for (const [index, rung] of this.rungs.entries()) rung?.show(power[index], lines);
  }

  /** Marks what is in the line with the cursor, and scrolls to it. */
  private mark(): void {
    const { state } = this.editors.view;
    const line = state.doc.lineAt(state.selection.main.head).number;
    let current: Shape | undefined;
    for (const shape of this.shapes()) {
      const isHere = shape.element.line === line;
      if (isHere) current ??= shape;
      shape.group.classList.toggle("current", isHere);
    }
    this.walk.reveal(current);
  }

  private shapes(): Shape[] {
    return this.rungs.flatMap((rung) => rung?.shapes ?? []);
  }

  private valuesOf(shape: Shape, pin?: LadderPin): Value[] {
    const values = this.lines.get(shape.element.line)?.values ?? [];
    return pin ? values.filter((value) => value.name === pin.text) : values;
  }

  private goTo(line: number): void {
    if (this.network) this.editors.openLine(this.network.file, line);
  }

  /** A click on an operand with a value opens its menu, one elsewhere leads to the line. */
  private clicked(event: MouseEvent): void {
    const shape = this.walk.at(event.target);
    if (!shape || !(event.target instanceof Element)) return;
    const pin = shape.pinAt(event.target);
    const values = pin ? this.valuesOf(shape, pin) : [];
    if (values.length > 0) {
      this.walk.focus(shape);
      valuesMenu(this.core, values, event.target);
    } else this.goTo(shape.element.line);
  }

  private keys(event: KeyboardEvent): void {
    this.walk.keys(event, (shape) => {
      const values = this.valuesOf(shape);
      if (event.key === "Enter" && values.length > 0) valuesMenu(this.core, values, shape.button);
      else if (event.key === "Enter" || event.key === " ") this.goTo(shape.element.line);
      else return false;
      return true;
    });
  }
}

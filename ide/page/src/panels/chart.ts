// The charts of the file in the editor, with the steps that are active. To be read: they are
// written as text.
import { Sheet, type Shape } from "../chart/sheet";
import type { Core } from "../core/core";
import type { Chart as Charts } from "../core/protocol";
import type { Editors } from "../editor/editors";
import { button, h, s } from "../page/dom";
import { tellsOfProgram, type Header } from "../page/header";
import { Walk } from "../page/walk";
import type { Project } from "../project/project";
import { onLanguage } from "../text/language";

/** So long nothing is asked for while a text is being written. */
const QUIET_MS = 120;
const ZOOM = { min: 0.25, max: 3, step: 1.25 };

export class Chart {
  readonly element: HTMLElement;
  private place = h("div", { class: "sheets" });
  private tools: HTMLElement;
  private walk: Walk<Shape>;
  private isShown = false;
  private timer = 0;
  private charts: Charts | null = null;
  private drawn = "";
  private sheets: Sheet[] = [];
  private svg: SVGSVGElement | null = null;
  private zoom = 1;
  private situation: { id: number; steps: (boolean | null)[][] } = { id: 0, steps: [] };

  constructor(
    private core: Core,
    private editors: Editors,
    project: Project,
    header: Header,
  ) {
    this.tools = h(
      "div",
      { class: "tools" },
      button("chartSmaller", () => this.scale(this.zoom / ZOOM.step)),
      button("chartLarger", () => this.scale(this.zoom * ZOOM.step)),
      button("chartFit", () => this.fit()),
    );
    this.element = h("div", { class: "chart" }, this.tools, this.place);
    this.walk = new Walk(this.element, () => this.shapes());
    this.element.addEventListener("keydown", (event) => this.keys(event));
    this.place.addEventListener("click", ({ target }) => this.goTo(this.walk.at(target)));
    editors.onCursor(() => this.mark());
    editors.onCurrent(() => this.soon());
    project.onFiles(() => this.soon());
    core.on("problems", () => this.soon());
    core.on("situation", (situation) => {
      this.situation = situation;
      this.show();
    });
    header.onStatus((status) => {
      if (tellsOfProgram(status) || this.situation.id === 0) return;
      this.situation = { id: 0, steps: [] };
      this.show();
    });
    onLanguage(() => this.draw());
    this.draw();
  }

  /** Charts are asked for only while they can be seen, and so are their steps. */
  shown(isShown: boolean): void {
    this.isShown = isShown;
    if (isShown) this.soon();
    else if (this.charts) void this.ask("");
  }

  private soon(): void {
    clearTimeout(this.timer);
    if (!this.isShown) return;
    this.timer = window.setTimeout(() => void this.ask(this.editors.current ?? ""), QUIET_MS);
  }

  private async ask(file: string): Promise<void> {
    const charts = await this.core.ask({ do: "chart", file }).catch(() => null);
    if (this.isShown && file !== (this.editors.current ?? "")) return;
    this.charts = charts;
    if (!this.isShown) return;
    const drawn = JSON.stringify({ ...charts, id: 0 });
    if (drawn !== this.drawn) {
      this.drawn = drawn;
      this.draw();
    } else this.show();
    this.mark();
  }

  private draw(): void {
    const { charts } = this;
    this.tools.hidden = !charts || charts.obstacle !== null;
    this.sheets = charts?.sheets.map((sheet) => new Sheet(sheet)) ?? [];
    this.svg = null;
    if (!charts) this.place.replaceChildren(h("p", { class: "nothing", text: "chartNothing" }));
    else if (charts.obstacle !== null)
      this.place.replaceChildren(h("p", { class: "obstacle" }, charts.obstacle));
    else {
      const size = { viewBox: `0 0 ${charts.width} ${charts.height}`, role: "group" };
      this.svg = s("svg", size, ...this.sheets.map(({ group }) => group));
      this.place.replaceChildren(this.svg);
      this.scale(this.zoom);
      this.show();
      this.walk.begin();
    }
  }

  private scale(zoom: number): void {
    this.zoom = Math.min(ZOOM.max, Math.max(ZOOM.min, zoom));
    if (this.svg && this.charts) this.svg.style.width = `${this.charts.width * this.zoom}px`;
  }

  /** As large as fits. */
  private fit(): void {
    if (!this.charts) return;
    const { top } = this.place.getBoundingClientRect();
    const [wide, high] = [this.place.clientWidth, window.innerHeight - top - 12];
    this.scale(Math.min(wide / this.charts.width, high / this.charts.height));
  }

  private show(): void {
    const { id, steps } = this.situation;
    const isThis = id === this.charts?.id;
    for (const [index, sheet] of this.sheets.entries()) sheet.show((isThis && steps[index]) || []);
  }

  /** Marks the element with the cursor, and scrolls to it. */
  private mark(): void {
    if (!this.isShown || this.charts?.file !== this.editors.current) return;
    const { state } = this.editors.view;
    const line = state.doc.lineAt(state.selection.main.head).number;
    let current: Shape | undefined;
    for (const shape of this.shapes()) {
      const at = shape.element.line;
      if (at <= line && (!current || at > current.element.line)) current = shape;
    }
    for (const shape of this.shapes()) shape.group.classList.toggle("current", shape === current);
    this.walk.reveal(current);
  }

  private shapes(): Shape[] {
    return this.sheets.flatMap(({ steps, transitions }) => [...steps, ...transitions]);
  }

  private goTo(shape: Shape | undefined): void {
    if (shape && this.charts) this.editors.openLine(this.charts.file, shape.element.line);
  }

  private keys(event: KeyboardEvent): void {
    this.walk.keys(event, (shape) => {
      const leads = event.key === "Enter" || event.key === " ";
      if (leads) this.goTo(shape);
      return leads;
    });
  }
}

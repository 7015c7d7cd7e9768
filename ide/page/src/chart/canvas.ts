// The drawing as it is seen: which part of it, how large, and the nodes of what can be seen alone.
// Those of elements that did not change stay. What is done with the drawing is not known here.
import { h, s } from "../page/dom";
import { t } from "../text/language";
import { meet, type Drawn, type Item, type Point } from "./drawn";
import type { Note } from "./note";
import type { Frame } from "./protocol";
import { Shape, title } from "./shape";

export const ZOOM = { min: 0.1, max: 3, step: 1.25 };
/** What is as large as fits is not larger, and to be read not smaller. */
const ZOOM_FIT = { min: 0.7, max: 1.5 };
/** So far around what can be seen elements have nodes, in pixels. */
const AHEAD = 300;
/** Free ground around a drawing, and what is left between an element and the edge, in its units. */
const GROUND = 40;
const EDGE = 24;

/** What is to be seen of an element beside itself. */
export interface Looks {
  state(item: Item): boolean | null;
  note(item: Item): Note | null;
  isCrossed(item: Item): boolean;
  isSelected(item: Item): boolean;
  isCurrent(item: Item): boolean;
  /** Keeps its nodes although it cannot be seen. */
  isPinned(item: Item): boolean;
}

interface Layer {
  group: SVGGElement;
  transitions: SVGGElement;
  steps: SVGGElement;
  notes: SVGGElement;
}

export class Canvas {
  /** Lines over the drawing, while somebody draws. */
  readonly overlay = s("g", { class: "overlay", "aria-hidden": "true" });
  readonly svg = s("svg", { role: "group" }, this.overlay);
  /** Holds the drawing, and what is put over it. */
  readonly ground = h("div", { class: "ground" }, this.svg);
  /** What scrolls. */
  readonly element = h("div", { class: "sheets" }, this.ground);
  zoom = 1;
  /** The part that is shown. */
  bounds: Frame = [0, 0, 0, 0];
  private drawn: Drawn | null = null;
  private only: number | null = null;
  private shapes = new Map<string, Shape>();
  private layers: Layer[] = [];
  private frame = 0;
  private listeners: (() => void)[] = [];

  constructor(private looks: Looks) {
    this.element.addEventListener("scroll", () => this.later());
    new ResizeObserver(() => this.later()).observe(this.element);
  }

  /** Is told when another part can be seen, or in another size. */
  onView(listener: () => void): void {
    this.listeners.push(listener);
  }

  /** Whether action blocks are shown. */
  showBlocks(isShown: boolean): void {
    this.svg.classList.toggle("without-blocks", !isShown);
  }

  get hasBlocks(): boolean {
    return !this.svg.classList.contains("without-blocks");
  }

  /** Draws charts, or one of them. */
  draw(drawn: Drawn | null, only: number | null): void {
    this.drawn = drawn;
    this.only = only;
    const frame = only === null ? undefined : drawn?.sheet(only)?.frame;
    const all: Frame = [0, 0, drawn?.charts.width ?? 0, drawn?.charts.height ?? 0];
    const [x, y, width, height] = frame ?? all;
    this.bounds = [x - GROUND, y - GROUND, width + 2 * GROUND, height + 2 * GROUND];
    this.drawLayers();
    this.scale(this.zoom);
    this.refresh();
  }

  private drawLayers(): void {
    const sheets = this.drawn?.charts.sheets ?? [];
    while (this.layers.length > sheets.length) this.layers.pop()?.group.remove();
    for (const [at, sheet] of sheets.entries()) {
      const layer = (this.layers[at] ??= this.layer());
      layer.group.setAttribute("aria-label", t("chartOf", sheet.name));
      const isElsewhere = this.only !== null && this.only !== at;
      layer.group.toggleAttribute("hidden", isElsewhere || sheet.isFolded);
      layer.group.firstElementChild?.replaceWith(title(sheet.title, sheet.name));
    }
  }

  private layer(): Layer {
    const [transitions, steps, notes] = [s("g"), s("g"), s("g")];
    const group = s("g", { role: "group" }, title([0, 0], ""), transitions, steps, notes);
    this.overlay.before(group);
    return { group, transitions, steps, notes };
  }

  /** Shows before the next frame what has changed. */
  later(): void {
    cancelAnimationFrame(this.frame);
    this.frame = requestAnimationFrame(() => this.refresh());
  }

  /** What can be seen, in units of the drawing. */
  view(ahead = 0): Frame {
    const { scrollLeft, scrollTop, clientWidth, clientHeight } = this.element;
    const [x, y] = this.bounds;
    const by = ahead / this.zoom;
    return [
      x + scrollLeft / this.zoom - by,
      y + scrollTop / this.zoom - by,
      clientWidth / this.zoom + 2 * by,
      clientHeight / this.zoom + 2 * by,
    ];
  }

  /** Gives nodes to what can be seen, and takes them from the rest. */
  refresh(): void {
    const view = this.view(AHEAD);
    const shown = (this.drawn?.items ?? []).filter((item) => {
      const isSeen = (this.only === null || this.only === item.sheet) && meet(item.box, view);
      const isKept = this.looks.isPinned(item) || this.shapes.get(item.key)?.isMoved;
      return isSeen || isKept;
    });
    this.keep(new Set(shown.map(({ key }) => key)));
    // From the last one on, so that each is put before the one that comes after it in the chart.
    const next = new Map<SVGGElement | undefined, SVGGElement>();
    for (const item of shown.toReversed()) {
      const layer = this.layerOf(item);
      const { group } = this.mount(item);
      put(layer, group, next.get(layer) ?? null);
      next.set(layer, group);
    }
    for (const listener of this.listeners) listener();
  }

  private keep(keys: Set<string>): void {
    for (const [key, shape] of this.shapes)
      if (!keys.has(key)) {
        shape.remove();
        this.shapes.delete(key);
      }
  }

  private layerOf({ sheet, kind }: Item): SVGGElement | undefined {
    const layer = this.layers[sheet];
    return kind === "step" ? layer?.steps : layer?.transitions;
  }

  private mount(item: Item): Shape {
    let shape = this.shapes.get(item.key);
    if (shape) shape.update(item);
    else {
      shape = new Shape(item);
      this.shapes.set(item.key, shape);
    }
    shape.show(this.looks.state(item));
    shape.tell(this.looks.note(item), this.looks.isCrossed(item));
    const notes = this.layers[item.sheet]?.notes;
    if (shape.noted.parentNode !== notes) notes?.append(shape.noted);
    shape.select(this.looks.isSelected(item));
    shape.group.classList.toggle("current", this.looks.isCurrent(item));
    return shape;
  }

  /** The nodes of an element. */
  shape(item: Item): Shape {
    const there = this.shapes.get(item.key);
    if (there) return there;
    const layer = this.layerOf(item);
    const shape = this.mount(item);
    put(layer, shape.group, this.after(item)?.group ?? null);
    return shape;
  }

  /** The next element in the chart's order that has nodes in the same layer. */
  private after(item: Item): Shape | undefined {
    const items = this.drawn?.items ?? [];
    const later = items.slice(items.findIndex(({ key }) => key === item.key) + 1);
    const layer = this.layerOf(item);
    const next = later.find((one) => this.layerOf(one) === layer && this.shapes.has(one.key));
    return next && this.shapes.get(next.key);
  }

  /** The element that a node belongs to, and the number of the action. */
  at(node: EventTarget | null): { item: Item; action: number | null } | undefined {
    if (!(node instanceof Element)) return undefined;
    const key = node.closest("[data-key]")?.getAttribute("data-key");
    const item = key ? this.drawn?.byKeyOf(key) : undefined;
    const action = node.closest("[data-action]")?.getAttribute("data-action");
    return item && { item, action: action ? Number(action) : null };
  }

  /** A point of the window in the drawing. */
  point({ clientX, clientY }: { clientX: number; clientY: number }): Point {
    const { left, top } = this.svg.getBoundingClientRect();
    const [x, y] = this.bounds;
    return [x + (clientX - left) / this.zoom, y + (clientY - top) / this.zoom];
  }

  private scale(zoom: number): void {
    this.zoom = Math.min(ZOOM.max, Math.max(ZOOM.min, zoom));
    const [x, y, width, height] = this.bounds;
    this.svg.setAttribute("viewBox", `${x} ${y} ${width} ${height}`);
    this.svg.style.width = `${width * this.zoom}px`;
    this.svg.style.height = `${height * this.zoom}px`;
  }

  /** Another size; a point of the window stays where it is, without one the middle. */
  zoomTo(zoom: number, at?: { clientX: number; clientY: number }): void {
    const { left, top, width, height } = this.element.getBoundingClientRect();
    const fixed = at ?? { clientX: left + width / 2, clientY: top + height / 2 };
    const before = this.point(fixed);
    this.scale(zoom);
    const after = this.point(fixed);
    this.element.scrollLeft += (before[0] - after[0]) * this.zoom;
    this.element.scrollTop += (before[1] - after[1]) * this.zoom;
    this.refresh();
  }

  /** Larger, or smaller, by one step. */
  zoomBy(step: 1 | -1): void {
    this.zoomTo(this.zoom * ZOOM.step ** step);
  }

  /** Scrolls so that a point is in the middle. */
  centre([x, y]: Point): void {
    const { clientWidth, clientHeight } = this.element;
    this.element.scrollLeft = (x - this.bounds[0]) * this.zoom - clientWidth / 2;
    this.element.scrollTop = (y - this.bounds[1]) * this.zoom - clientHeight / 2;
  }

  /** As large as fits. */
  fit(): void {
    this.scale(Math.min(this.fitting(), ZOOM_FIT.max));
    this.refresh();
  }

  /** The beginning of another drawing: as much of it as can be read. */
  begin(): void {
    this.scale(Math.min(1, Math.max(ZOOM_FIT.min, this.fitting())));
    this.element.scrollTo(0, 0);
  }

  private fitting(): number {
    const [, , width, height] = this.bounds;
    const { clientWidth, clientHeight } = this.element;
    return Math.min(clientWidth / width, clientHeight / height);
  }

  /** Scrolls so far that a frame can be seen. */
  reveal([x, y, width, height]: Frame): void {
    const [left, top, wide, high] = this.view();
    const by = (at: number, size: number, from: number, room: number) => {
      if (at - EDGE < from || size > room) return at - EDGE - from;
      return Math.max(0, at + size + EDGE - from - room);
    };
    const isIn = meet([left, top, wide, high], [x, y, width, height]);
    if (isIn && (width > wide || height > high)) return;
    this.element.scrollLeft += by(x, width, left, wide) * this.zoom;
    this.element.scrollTop += by(y, height, top, high) * this.zoom;
  }
}

/** Puts nodes before others of a layer; those that are there already keep the focus. */
function put(layer: SVGGElement | undefined, group: SVGGElement, next: SVGGElement | null): void {
  if (group.parentNode !== layer || group.nextElementSibling !== next)
    layer?.insertBefore(group, next);
}

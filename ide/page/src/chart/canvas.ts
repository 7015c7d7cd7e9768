// The drawing as it is seen: the nodes of what can be seen alone. Those of elements that did not
// change stay. What is done with the drawing is not known here.
import { s } from "../page/dom";
import { Ground, meet } from "../page/ground";
import { t } from "../text/language";
import type { Drawn, Item } from "./drawn";
import type { Note } from "./note";
import type { Frame } from "./protocol";
import { Shape, title } from "./shape";

/** So far around what can be seen elements have nodes, in pixels. */
const AHEAD = 300;

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

export class Canvas extends Ground {
  /** Lines over the drawing, while somebody draws. */
  readonly overlay = s("g", { class: "overlay", "aria-hidden": "true" });
  private drawn: Drawn | null = null;
  private only: number | null = null;
  private shapes = new Map<string, Shape>();
  private layers: Layer[] = [];
  private listeners: (() => void)[] = [];

  constructor(private looks: Looks) {
    super();
    this.svg.append(this.overlay);
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
    this.drawLayers();
    this.spread(frame ?? all);
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
}

/** Puts nodes before others of a layer; those that are there already keep the focus. */
function put(layer: SVGGElement | undefined, group: SVGGElement, next: SVGGElement | null): void {
  if (group.parentNode !== layer || group.nextElementSibling !== next)
    layer?.insertBefore(group, next);
}

// Diagrams as they are seen: the nodes of what can be seen alone. What is chosen of them, and their
// values, others know.
import { s } from "../page/dom";
import { Ground, meet, type Frame, type Point } from "../page/ground";
import { t } from "../text/language";
import type { DiagramElement, DiagramLink, Diagrams, DiagramSheet, Pin } from "./protocol";
import type { Selection } from "./selection";
import { ElementShape, ground, groupKey, LinkShape } from "./shape";
import type { Live } from "./live";

/** So far around what can be seen elements have nodes, in pixels. */
const AHEAD = 200;

/** An element with where it is. */
export interface Item {
  key: string;
  sheet: number;
  element: DiagramElement;
  /** The numbers of its inputs to which links lead. */
  linked: number[];
  /** The name of its group; of none empty. */
  group: string;
}

/** What has nodes while it can be seen, with the outputs whose values it shows. */
type Part = {
  box: Frame;
  sheet: number;
  outputs: Pin[];
} & ({ item: Item; make: (key: string) => ElementShape } | { item: null; make: () => LinkShape });

interface Layer {
  group: SVGGElement;
  links: SVGGElement;
  elements: SVGGElement;
}

export class Sheets extends Ground {
  /** Lines over the drawing, while somebody draws. */
  readonly overlay = s("g", { class: "overlay", "aria-hidden": "true" });
  items: Item[] = [];
  private parts: Part[] = [];
  private shapes = new Map<Part, ElementShape | LinkShape>();
  private elements = new Map<Item, ElementShape>();
  private layers: Layer[] = [];

  constructor(
    private live: Live,
    /** Its focus keeps its nodes. */
    private selection: Selection,
    private refreshed: () => void,
  ) {
    super();
    this.svg.append(this.overlay);
  }

  draw(drawn: Diagrams | null): void {
    for (const { group } of this.layers) group.remove();
    this.shapes.clear();
    this.elements.clear();
    const sheets = drawn?.sheets ?? [];
    this.items = sheets.flatMap(itemsOf);
    this.selection.take(this.items);
    this.layers = sheets.map((sheet, at) => {
      const [links, elements] = [s("g"), s("g")];
      const label = t("diagramOf", sheet.name);
      const group = s(
        "g",
        { role: "group", "aria-label": label },
        ...ground(sheet, at),
        links,
        elements,
      );
      this.overlay.before(group);
      return { group, links, elements };
    });
    const links = sheets.flatMap(({ links, elements }, sheet) =>
      links.map((link) => linkPart(sheet, link, elements)),
    );
    this.parts = [...links, ...this.items.map(elementPart)];
    this.spread([0, 0, drawn?.width ?? 0, drawn?.height ?? 0]);
  }

  /** Gives nodes to what can be seen, and takes them from the rest. */
  refresh(): void {
    const view = this.view(AHEAD);
    const kept = this.selection.focus;
    for (const part of this.parts) {
      const isSeen = meet(part.box, view) || (part.item !== null && part.item === kept);
      const shape = this.shapes.get(part);
      if (isSeen && !shape) this.mount(part);
      else if (!isSeen && shape) {
        shape.group.remove();
        this.shapes.delete(part);
        if (part.item) this.elements.delete(part.item);
      }
    }
    this.refreshed();
    this.showValues();
  }

  private mount(part: Part): void {
    const layer = this.layers[part.sheet];
    if (part.item === null) return this.put(part, part.make(), layer?.links);
    const shape = part.make(part.item.key);
    this.elements.set(part.item, shape);
    this.put(part, shape, layer?.elements);
  }

  private put(part: Part, shape: ElementShape | LinkShape, layer?: SVGGElement): void {
    this.shapes.set(part, shape);
    layer?.append(shape.group);
  }

  /** The outputs that can be seen. */
  outputs(): Pin[] {
    return [...this.shapes.keys()].flatMap((part) => part.outputs);
  }

  showValues(): void {
    const shown = [...this.shapes];
    const values = this.live.of(shown.flatMap(([part]) => part.outputs));
    let from = 0;
    for (const [{ outputs }, shape] of shown) {
      shape.show(values.slice(from, from + outputs.length));
      from += outputs.length;
    }
  }

  /** The nodes of an element, if it has any. */
  shape(item: Item): ElementShape | undefined {
    return this.elements.get(item);
  }

  /** The element that a node belongs to. */
  at(node: EventTarget | null): Item | undefined {
    if (!(node instanceof Element)) return undefined;
    const key = node.closest("[data-key]")?.getAttribute("data-key");
    return this.items.find((item) => item.key === key);
  }

  /** The group that a node is a part of, apart from elements. */
  groupNode(node: EventTarget | null): Element | null {
    return node instanceof Element ? node.closest("[data-group]") : null;
  }

  /** The elements of that. */
  groupAt(node: EventTarget | null): Item[] {
    const key = this.groupNode(node)?.getAttribute("data-group");
    return this.items.filter(({ sheet, group }) => groupKey(sheet, group) === key);
  }
}

function itemsOf({ elements, links, groups }: DiagramSheet, sheet: number): Item[] {
  const linked = elements.map((): number[] => []);
  const names = elements.map(() => "");
  for (const { name, elements } of groups) for (const at of elements) names[at] = name;
  for (const { to } of links) linked[to[0]]?.push(to[1]);
  return elements.map((element, at) => {
    const key = `${sheet}:${element.id}`;
    return { key, sheet, element, linked: linked[at] ?? [], group: names[at] ?? "" };
  });
}

function elementPart(item: Item): Part {
  const { element } = item;
  const make = (key: string) => new ElementShape(element, key);
  return { box: element.room, sheet: item.sheet, outputs: element.outputs, item, make };
}

function linkPart(sheet: number, link: DiagramLink, elements: DiagramElement[]): Part {
  const output = elements[link.from[0]]?.outputs[link.from[1]];
  const make = () => new LinkShape(link);
  return { box: around(link.points), sheet, outputs: output ? [output] : [], item: null, make };
}

function around(points: readonly Point[]): Frame {
  const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
  const [left, top] = [Math.min(...xs), Math.min(...ys)];
  return [left, top, Math.max(...xs) - left, Math.max(...ys) - top];
}

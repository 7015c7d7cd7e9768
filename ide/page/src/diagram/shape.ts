// Elements, links and groups of a diagram as nodes of a picture. A value beside an output shows for
// all links from there.
import type { Value } from "../core/protocol";
import { s } from "../page/dom";
import type { Frame, Point } from "../page/ground";
import { t } from "../text/language";
import type { DiagramElement, DiagramLink, DiagramSheet, Pin } from "./protocol";

/** From the edge of a box to a text in it; the line to a text beside it. */
const INSET = 8;
const ARROW = 8;
/** Height of the bar with the name of a group. */
const BAR = 20;
/** Digits of a value as it is drawn. */
const DIGITS = 5;

export class ElementShape {
  /** What has the focus and the name. */
  readonly button: SVGGElement;
  readonly group: SVGGElement;
  private values: SVGTextElement[];
  private said = "";

  constructor(
    readonly element: DiagramElement,
    key: string,
  ) {
    this.button = s("g", { role: "button", tabindex: -1 }, rect(element.frame, "body"));
    const picture = s("g", { "aria-hidden": "true" }, ...inside(element), ...outside(element));
    this.values = element.outputs.map(({ at }) => text(valueAt(element, at), "", "live-value"));
    const parts = [this.button, picture, ...this.values, ...ports(element)];
    this.group = s("g", { class: "element", "data-key": key }, ...parts);
    this.show([]);
  }

  /** The values of its outputs. */
  show(values: (Value | undefined)[]): void {
    const { element } = this;
    const words = values.map((value) => (value ? short(value) : ""));
    for (const [at, node] of this.values.entries())
      if (node.textContent !== (words[at] ?? "")) node.textContent = words[at] ?? "";
    const of = t("diagramElement", element.order, element.fullName, element.block ?? ":=");
    const outputs = element.outputs.flatMap(({ name }, at) =>
      words[at] ? `${name} ${words[at]}`.trim() : [],
    );
    const said = [of, element.comment, ...outputs].filter(Boolean).join(", ");
    if (said === this.said) return;
    this.said = said;
    this.button.setAttribute("aria-label", said);
  }
}

/** What a pointer finds of the pins. */
function ports({ inputs, outputs }: DiagramElement): SVGElement[] {
  const port = (side: "input" | "output") => (pin: Pin, at: number) => {
    const [cx, cy] = pin.at;
    return s("circle", { class: "port", cx, cy, r: 7, "data-side": side, "data-pin": at });
  };
  return [...inputs.map(port("input")), ...outputs.map(port("output"))];
}

/** Right of the box, above the link. */
function valueAt({ frame: [x, , width] }: DiagramElement, [, y]: Point): Point {
  return [x + width + 4, y - 8];
}

/** A value in few characters. */
export function short({ form, number, text }: Value): string {
  if (form !== "real" || number === null) return text;
  return String(Number(number.toPrecision(DIGITS)));
}

function inside(element: DiagramElement): SVGElement[] {
  const { frame, name, block, order } = element;
  const [x, y, width, height] = frame;
  const middle = x + width / 2;
  const place = text([x + width - 2, y - 7], String(order), "order");
  if (block === null) {
    const given = element.inputs[0]?.text ?? "";
    const at: Point = [middle, given === "" ? y + height / 2 : y + 13];
    return [place, text(at, name, "name"), text([middle, y + height - 11], given, "assigned")];
  }
  return [
    place,
    text([middle, y + 13], name, "name"),
    text([middle, y + 29], block, "note"),
    ...element.inputs.map(({ at, name }) => text([x + INSET, at[1]], name, "pin")),
    ...element.outputs.map(({ at, name }) => text([x + width - INSET, at[1]], name, "pin output")),
  ];
}

/** What is given and taken beside the box of a call. */
function outside({ frame: [x, , width], block, inputs, outputs }: DiagramElement): SVGElement[] {
  if (block === null) return [];
  return [
    ...inputs.flatMap((pin) => beside(pin, x, -1)),
    ...outputs.flatMap((pin) => beside(pin, x + width, 1)),
  ];
}

function beside(pin: Pin, edge: number, outward: 1 | -1): SVGElement[] {
  const [, y] = pin.at;
  if (pin.text === "") return [];
  const at = edge + outward * (INSET + 4);
  const wire = line(
    [
      [edge, y],
      [edge + outward * INSET, y],
    ],
    "wire",
  );
  return [wire, text([at, y], pin.text, outward < 0 ? "given left" : "given")];
}

export class LinkShape {
  readonly group: SVGGElement;

  constructor(link: DiagramLink) {
    const [x, y] = link.points.at(-1) ?? [0, 0];
    this.group = s(
      "g",
      { class: link.isFeedback ? "feedback" : "link" },
      line(link.points, "wire"),
      s("path", { class: "arrow", d: `M${x} ${y}l${-ARROW} -4v8z` }),
    );
  }

  /** The value that it carries: of a bit whether it is on. */
  show([value]: (Value | undefined)[]): void {
    this.group.classList.toggle("on", value?.form === "bit" && value.number === 1);
  }
}

/** What is behind the elements of a sheet, and its name; `sheet` is its number. */
export function ground(drawn: DiagramSheet, sheet: number): SVGElement[] {
  const { groups, junctions, name, title } = drawn;
  return [
    text(title, name, "title"),
    ...groups.map(({ name, frame }) => groupOf(name, frame, sheet)),
    ...junctions.map(([x, y]) => s("circle", { class: "arrow", cx: x, cy: y, r: 3.5 })),
  ];
}

/** By which a group of a sheet is known. */
export function groupKey(sheet: number, name: string): string {
  return `${sheet}:${name}`;
}

/** A frame, with a bar by which its elements are chosen and moved together. */
function groupOf(name: string, frame: Frame, sheet: number): SVGElement {
  const [x, y, width] = frame;
  return s(
    "g",
    {
      role: "button",
      tabindex: 0,
      class: "grouped",
      "data-group": groupKey(sheet, name),
      "aria-label": t("diagramGroupNamed", name),
    },
    rect(frame, "group"),
    rect([x, y, width, BAR], "handle"),
    text([x + width - INSET, y + 12], name, "group-name"),
  );
}

function rect([x, y, width, height]: Frame, name: string): SVGRectElement {
  return s("rect", { x, y, width, height, class: name });
}

function line(points: readonly Point[], name: string): SVGPathElement {
  return s("path", { class: name, d: `M${points.map((point) => point.join(" ")).join("L")}` });
}

function text([x, y]: Point, words: string, name: string): SVGTextElement {
  return s("text", { x, y, class: name }, words);
}

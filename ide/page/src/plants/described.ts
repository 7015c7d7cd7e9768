// The picture of a plant that a file describes: shapes of a fixed set. What comes from the file is
// numbers, and words that are only ever text.
import type { PlantInfo, Shape } from "../core/protocol";
import { s } from "../page/dom";
import { inLanguage, type Words } from "../text/language";
import { move, showIf, type Drawing, type State } from "./picture";
import type { Pins } from "../core/protocol";

const WIDTH = 640;
const HEIGHT = 400;
const FULL = 1000;
/** The colours that there are; another one is none. */
const COLOURS = ["red", "yellow", "green", "blue", "brown", "grey", "dark", "light"];

/** A shape on the sheet. `show` takes how it is, behind how far it is moved. */
interface Drawn {
  element: SVGElement;
  show(values: number[]): void;
}

export class Described implements Drawing {
  readonly element: SVGSVGElement;
  private shapes: { shape: Shape; drawn: Drawn }[];

  constructor(private info: PlantInfo) {
    this.shapes = info.shapes.map((shape) => ({ shape, drawn: draw(shape) }));
    this.element = s(
      "svg",
      { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: "drawing described", role: "img" },
      ...this.shapes.map(({ drawn }) => drawn.element),
    );
    this.relabel();
  }

  /** Says everything again, in the language that is chosen. */
  relabel(): void {
    this.element.setAttribute("aria-label", inLanguage(this.info.title));
    for (const { shape, drawn } of this.shapes)
      if (shape.kind === "text" && shape.words) drawn.element.textContent = inLanguage(shape.words);
  }

  show(_state: State, _pins: Pins, places: number[][]): void {
    for (const [index, { shape, drawn }] of this.shapes.entries()) {
      const [moved = 0, ...values] = places[index] ?? [];
      const isShown = (places[index] ?? [0]).length > 0;
      showIf(drawn.element, isShown);
      if (!isShown) continue;
      const [x, y] = shape.at;
      const [dx, dy] = shape.by;
      move(drawn.element, x + (dx * moved) / FULL, y + (dy * moved) / FULL);
      drawn.show(values);
    }
  }
}

function draw(shape: Shape): Drawn {
  const [a = 0, b = 0, c = 0, d = 0] = shape.size;
  const paint = COLOURS.includes(shape.colour) ? `paint ${shape.colour}` : "paint";
  const still = (element: SVGElement): Drawn => ({ element, show: () => {} });
  switch (shape.kind) {
    case "box":
      return still(s("rect", { width: a, height: b, rx: 2, class: paint }));
    case "circle":
      return still(s("circle", { r: a, class: paint }));
    case "line": {
      const [x, y] = shape.at;
      return still(s("line", { x2: a - x, y2: b - y, class: `${paint} stroke` }));
    }
    case "lamp":
      return lamp(s("circle", { r: a, class: `${paint} bulb` }));
    case "text":
      return still(s("text", { class: paint }));
    case "value":
      return value(shape.words, s("text", { class: `${paint} count` }));
    case "level":
      return level(a, b, paint);
    case "pieces":
      return pieces(shape.at, [a, b], [c, d], paint);
    default:
      return still(s("g"));
  }
}

function lamp(element: SVGElement): Drawn {
  return { element, show: ([isOn]) => element.classList.toggle("on", isOn === 1) };
}

function value(words: Words | null, element: SVGElement): Drawn {
  const show = ([number = 0]: number[]) => {
    const text = `${words ? inLanguage(words) : ""} ${number.toLocaleString()}`;
    if (element.textContent !== text) element.textContent = text;
  };
  return { element, show };
}

function level(width: number, height: number, paint: string): Drawn {
  const filled = s("rect", { width, class: paint });
  const vessel = s("rect", { width, height, class: "vessel" });
  const show = ([part = 0]: number[]) => {
    const filledHeight = (height * part) / FULL;
    filled.setAttribute("y", String(height - filledHeight));
    filled.setAttribute("height", String(filledHeight));
  };
  return { element: s("g", {}, filled, vessel), show };
}

/** Boxes on a way from `from` to `to`, their fronts where the pieces' fronts are. */
function pieces(
  from: [number, number],
  to: [number, number],
  [width, height]: [number, number],
  paint: string,
): Drawn {
  const element = s("g");
  const boxes: SVGElement[] = [];
  const way = [to[0] - from[0], to[1] - from[1]] as const;
  const length = Math.hypot(...way) || 1;
  const [along, down] = [way[0] / length, way[1] / length];
  const half = (Math.abs(along) * width + Math.abs(down) * height) / 2;
  const show = (fronts: number[]) => {
    for (const [index, front] of fronts.entries()) {
      const box = (boxes[index] ??= s("rect", {
        x: -width / 2,
        y: -height / 2,
        width,
        height,
        rx: 3,
        class: `${paint} piece`,
      }));
      if (!box.parentNode) element.append(box);
      const at = (length * front) / FULL - half;
      move(box, along * at, down * at);
    }
    for (const box of boxes.slice(fronts.length)) box.remove();
  };
  return { element, show };
}

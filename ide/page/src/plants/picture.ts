// What a drawing of a plant is, and pieces that several of them have.
import type { Pins } from "../core/protocol";
import { s, type Child } from "../page/dom";
import type { Key } from "../text/language";
import { say } from "../page/dom";

/** How a plant is: numbers under their names. What is missing is not drawn. */
export type State = ReadonlyMap<string, number>;

export interface Drawing {
  element: SVGSVGElement;
  /** `places`: how the shapes of a file are. */
  show(state: State, pins: Pins, places: number[][]): void;
  /** Says again what is not from the table. */
  relabel?(): void;
}

export interface Picture {
  /** As `awl-sim --plant` names it. */
  name: string;
  title: Key;
  draw(): Drawing;
}

/** The sheet for a drawing, with a name for those who do not see it. */
export function sheet(
  width: number,
  height: number,
  label: Key,
  ...children: Child[]
): SVGSVGElement {
  const element = s(
    "svg",
    { viewBox: `0 0 ${width} ${height}`, class: "drawing", role: "img" },
    ...children,
  );
  say(element, "aria-label", label);
  return element;
}

/** A text from the table. */
export function words(x: number, y: number, key: Key, anchor = "start"): SVGTextElement {
  const element = s("text", { x, y, "text-anchor": anchor });
  say(element, "text", key);
  return element;
}

/** A lamp for a point, named after it. */
export class Lamp {
  readonly element: SVGGElement;

  constructor(
    x: number,
    y: number,
    private point: string,
    side: "left" | "right" = "right",
  ) {
    const isInput = point.startsWith("I");
    const circle = s("circle", {
      cx: x,
      cy: y,
      r: 6,
      class: isInput ? "lamp input" : "lamp output",
    });
    const at = side === "right" ? x + 11 : x - 11;
    const anchor = side === "right" ? "start" : "end";
    const text = s("text", { x: at, y: y + 4, "text-anchor": anchor, class: "point" }, point);
    this.element = s("g", { class: "point-lamp" }, circle, text);
  }

  show(pins: Pins): void {
    this.element.classList.toggle("on", isOn(this.point, pins));
  }
}

/** Whether a point `I0.3` or `Q0.3` is on. */
export function isOn(point: string, { inputs, outputs }: Pins): boolean {
  const bits = point.startsWith("I") ? inputs : outputs;
  return ((bits >> Number(point.slice(-1))) & 1) === 1;
}

/** Shows an element only where its value is known. */
export function showIf(element: SVGElement, isKnown: boolean): void {
  element.toggleAttribute("hidden", !isKnown);
  element.style.display = isKnown ? "" : "none";
}

/** Moves an element, and turns it. */
export function move(element: SVGElement, x: number, y: number, degrees = 0): void {
  const turn = degrees === 0 ? "" : ` rotate(${degrees})`;
  element.setAttribute("transform", `translate(${x.toFixed(1)} ${y.toFixed(1)})${turn}`);
}

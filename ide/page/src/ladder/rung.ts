// A rung as a picture: its elements, the wires between them, and power flow as colours.
import type { LadderElement, LadderRung, Line, Power } from "../core/protocol";
import { s } from "../page/dom";
import { t } from "../text/language";
import { height, RAIL_AT, width, x, y } from "./metrics";
import { nameOf } from "./names";
import { colour, Shape } from "./shapes";

export class Rung {
  readonly element: SVGSVGElement;
  readonly shapes: Shape[];
  private wires: [SVGElement, number][];
  private rail: SVGElement;

  constructor(readonly rung: LadderRung) {
    const [wide, high] = [width(rung.columns), height(rung.rows)];
    this.rail = s("path", { d: `M${RAIL_AT} 0V${high}`, class: "rail" });
    this.wires = rung.wires.map(({ net, from, to }) => {
      const d = `M${x(from[0])} ${y(from[1])}L${x(to[0])} ${y(to[1])}`;
      return [s("path", { d, class: "wire" }), net];
    });
    this.shapes = rung.elements.map((element) => new Shape(element));
    this.element = s(
      "svg",
      { viewBox: `0 0 ${wide} ${high}`, role: "group" },
      this.rail,
      ...this.wires.map(([line]) => line),
      ...this.shapes.map((shape) => shape.group),
    );
    this.element.style.width = `${wide}px`;
    this.element.style.minWidth = `${wide * 0.75}px`;
    this.show(undefined, new Map());
  }

  /** Shows power flow and values; nothing where they are not known. */
  show(power: Power | undefined, lines: ReadonlyMap<number, Line>): void {
    const nets = power?.nets ?? [];
    colour(this.rail, nets[0] ?? null);
    for (const [line, net] of this.wires) colour(line, nets[net] ?? null);
    for (const [index, shape] of this.shapes.entries()) {
      const state = power?.elements[index] ?? null;
      shape.show(nets, state, lines.get(shape.element.line)?.values ?? []);
      this.name(shape.button, shape.element, state);
    }
  }

  private name(button: SVGGElement, element: LadderElement, state: boolean | null): void {
    const name = nameOf(element, state);
    if (button.getAttribute("aria-label") !== name) button.setAttribute("aria-label", name);
    const words = t("ladderLines", this.rung.lines[0], this.rung.lines[1]);
    if (this.element.getAttribute("aria-label") !== words)
      this.element.setAttribute("aria-label", words);
  }
}

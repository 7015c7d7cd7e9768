// The tank: a pump fills it, consumers draw from it.
import type { Pins } from "../core/protocol";
import { s } from "../page/dom";
import { Lamp, move, sheet, showIf, type Drawing, type Picture, type State } from "./picture";

const TOP = 60;
const BOTTOM = 330;
const LEFT = 220;
const WIDTH = 200;

export const tank: Picture = {
  name: "tank",
  title: "plantTank",
  draw: () => new Tank(),
};

/** Where a level of tenths of a percent is. */
function heightOf(level: number): number {
  return BOTTOM - (level / 1000) * (BOTTOM - TOP);
}

class Tank implements Drawing {
  readonly element: SVGSVGElement;
  private water = s("rect", { x: LEFT, width: WIDTH, class: "water" });
  private level = s("text", {
    x: LEFT + WIDTH / 2,
    y: (TOP + BOTTOM) / 2,
    "text-anchor": "middle",
    class: "level",
  });
  private inflow = s("path", { d: `M70 300V40H${LEFT + 40}V${BOTTOM}`, class: "flow-in" });
  private outflow = s("path", { d: `M${LEFT + WIDTH} 312H590V380`, class: "flow-out" });
  private impeller = s("path", { d: "M-14 0H14M0-14V14", class: "impeller" });
  private valve = s("path", { d: "M500 300l40 24v-24l-40 24z", class: "valve" });
  private lamps = [new Lamp(70, 350, "Q0.0"), new Lamp(520, 282, "Q0.1")];
  private switchLamp = new Lamp(LEFT + WIDTH + 20, 0, "I0.0");
  /** The overflow switch, at the height where it switches. */
  private overflow = s(
    "g",
    {},
    s("path", { d: `M${LEFT + WIDTH} 0h-16`, class: "frame" }),
    this.switchLamp.element,
  );

  constructor() {
    const pump = s(
      "g",
      { transform: "translate(70 312)" },
      s("circle", { r: 22, class: "metal" }),
      this.impeller,
    );
    this.element = sheet(
      640,
      400,
      "plantTank",
      s("path", { d: `M70 300V40H${LEFT + 40}V${TOP - 8}`, class: "pipe" }),
      s("path", { d: `M${LEFT + WIDTH} 312H590V380`, class: "pipe" }),
      this.inflow,
      this.water,
      this.outflow,
      s("path", {
        d: `M${LEFT} ${TOP}V${BOTTOM}H${LEFT + WIDTH}V${TOP}`,
        class: "wall",
      }),
      this.overflow,
      this.level,
      pump,
      this.valve,
      ...this.lamps.map((lamp) => lamp.element),
    );
  }

  show(state: State, pins: Pins): void {
    for (const lamp of [...this.lamps, this.switchLamp]) lamp.show(pins);
    const level = state.get("level");
    showIf(this.water, level !== undefined);
    const surface = heightOf(level ?? 0);
    this.water.setAttribute("y", surface.toFixed(1));
    this.water.setAttribute("height", (BOTTOM - surface).toFixed(1));
    this.level.textContent = level === undefined ? "" : `${(level / 10).toFixed(1)} %`;
    const isPumping = state.get("pump") === 1;
    showIf(this.inflow, isPumping);
    this.impeller.classList.toggle("runs", isPumping);
    const isOpen = state.get("outlet") === 1;
    showIf(this.outflow, isOpen && (level ?? 0) > 0);
    this.valve.classList.toggle("on", isOpen);
    const overflow = state.get("overflow");
    showIf(this.overflow, overflow !== undefined);
    move(this.overflow, 0, heightOf(overflow ?? 0));
  }
}

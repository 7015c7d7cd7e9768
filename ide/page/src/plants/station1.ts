// The measuring station: a platform that lifts pieces to a sensor, a piston that pushes them onto
// two ramps.
import type { Pins } from "../core/protocol";
import { s } from "../page/dom";
import { t, type Key } from "../text/language";
import {
  Lamp,
  move,
  sheet,
  showIf,
  words,
  type Drawing,
  type Picture,
  type State,
} from "./picture";

const WIDTH = 640;
const HEIGHT = 400;
/** The platform's upper side, at the bottom and at the top. */
const BOTTOM = 318;
const TOP = 150;
const SHAFT = 200;
const PLATFORM = 96;
const CENTRE = SHAFT + PLATFORM / 2;
/** How far the piston goes out, and where the height sensor's tip is. */
const PUSH = 90;
const SENSOR_UP = 46;
const SENSOR_TRAVEL = 62;
const HOLDER_UP = 124;
const HOLDER_TRAVEL = 44;
/** Heights of pieces in counts, and how they are drawn. */
const COUNTS_MIN = 160;
const PIECE_WIDTH = 52;
const PIECE_MIN = 16;
const PIECE_PER_COUNT = 0.42;
/** A piece on ramp 2: where it is held and where it has slid off, and how much it is tilted. */
const HELD = { x: 110, y: 27 };
const GONE = { x: 250, y: 54 };
const TILT = 11;
const FULL = 1000;

export const station1: Picture = {
  name: "station1",
  title: "plantStation1",
  draw: () => new Station1(),
};

class Station1 implements Drawing {
  readonly element: SVGSVGElement;
  private platform = s(
    "g",
    {},
    s("rect", { x: SHAFT, y: 0, width: PLATFORM, height: 12, class: "metal" }),
    s("rect", { x: CENTRE - 8, y: 12, width: 16, height: 300, class: "rod" }),
  );
  private piston = s(
    "g",
    {},
    s("rect", { x: SHAFT - 96, y: -18, width: 90, height: 8, class: "rod" }),
    s("rect", { x: SHAFT - 10, y: -28, width: 8, height: 28, class: "moving" }),
  );
  private cylinder = s("rect", { x: SHAFT - 118, y: -24, width: 56, height: 20, class: "metal" });
  private sensor = s(
    "g",
    {},
    s("rect", { x: CENTRE - 4, y: -60, width: 8, height: 60, class: "rod" }),
    s("path", { d: `M${CENTRE - 10} 0h20l-10 12z`, class: "moving" }),
  );
  private holder = s("rect", { x: 446, y: 0, width: 8, height: 44, class: "moving" });
  private piece = new Piece();
  private onRamp = new Piece();
  private good = count(620, 120);
  private rejected = count(620, 306);
  private fed = s("text", { x: 20, y: 96, class: "count" });
  private harm = s("text", { x: 620, y: 40, "text-anchor": "end", class: "count harm" });
  private lamps = [
    new Lamp(SHAFT - 22, BOTTOM + 26, "I0.0", "left"),
    new Lamp(SHAFT - 22, BOTTOM + 46, "I0.1", "left"),
    new Lamp(SHAFT - 22, TOP + 20, "I0.2", "left"),
    new Lamp(26, 40, "I0.3"),
    new Lamp(CENTRE - 60, 30, "I0.4", "left"),
    new Lamp(610, 244, "I0.5", "left"),
    new Lamp(SHAFT - 92, BOTTOM + 26, "Q0.0", "left"),
    new Lamp(SHAFT - 92, BOTTOM + 46, "Q0.1", "left"),
    new Lamp(26, 60, "Q0.2"),
    new Lamp(CENTRE - 60, 50, "Q0.3", "left"),
    new Lamp(474, 128, "Q0.4"),
  ];

  constructor() {
    const right = SHAFT + PLATFORM + 3;
    this.element = sheet(
      WIDTH,
      HEIGHT,
      "plantStation1",
      s("path", { d: `M${SHAFT - 3} 90V384M${right} 250V300`, class: "frame" }),
      s("path", { d: `M0 385H${WIDTH}`, class: "frame" }),
      ramp(TOP + 12),
      ramp(BOTTOM + 12),
      words(620, 100, "ramp2", "end"),
      words(620, 286, "ramp1", "end"),
      this.good,
      this.rejected,
      this.fed,
      this.harm,
      this.platform,
      this.piece.element,
      this.onRamp.element,
      this.holder,
      this.piston,
      this.cylinder,
      this.sensor,
      ...this.lamps.map((lamp) => lamp.element),
    );
  }

  show(state: State, pins: Pins): void {
    for (const lamp of this.lamps) lamp.show(pins);
    const part = (key: string) => (state.get(key) ?? 0) / FULL;
    const top = BOTTOM - part("lift") * (BOTTOM - TOP);
    showIf(this.platform, state.has("lift"));
    move(this.platform, 0, top);
    for (const element of [this.piston, this.cylinder]) showIf(element, state.has("piston"));
    move(this.piston, part("piston") * PUSH, top);
    move(this.cylinder, 0, top);
    showIf(this.sensor, state.has("sensor"));
    move(this.sensor, 0, SENSOR_UP + part("sensor") * SENSOR_TRAVEL);
    showIf(this.holder, state.has("holder"));
    move(this.holder, 0, HOLDER_UP + part("holder") * HOLDER_TRAVEL);
    this.piece.show(
      state.get("piece"),
      CENTRE - PIECE_WIDTH / 2 + part("piston") * PUSH * 0.6,
      top,
    );
    const slid = part("slid");
    const x = CENTRE - PIECE_WIDTH / 2 + HELD.x + slid * (GONE.x - HELD.x);
    this.onRamp.show(state.get("ramp2"), x, TOP + HELD.y + slid * (GONE.y - HELD.y), TILT);
    tell(this.good, "countGood", state.get("good"));
    tell(this.rejected, "countRejected", state.get("rejected"));
    tell(this.fed, "countFed", state.get("fed"));
    const harm = (state.get("collisions") ?? 0) + (state.get("conflicts") ?? 0);
    tell(this.harm, "countHarm", harm > 0 ? harm : undefined);
  }
}

/** A piece, as high as its counts say, with them on it. */
class Piece {
  private box = s("rect", { width: PIECE_WIDTH, rx: 3, class: "piece" });
  private counts = s("text", { x: PIECE_WIDTH / 2, y: -5, "text-anchor": "middle", class: "pin" });
  readonly element = s("g", {}, this.box, this.counts);

  /** Its lower left corner is at `x` and `bottom`. */
  show(counts: number | undefined, x: number, bottom: number, tilt = 0): void {
    showIf(this.element, !!counts);
    if (!counts) return;
    const height = PIECE_MIN + Math.max(0, counts - COUNTS_MIN) * PIECE_PER_COUNT;
    this.box.setAttribute("height", height.toFixed(1));
    this.counts.setAttribute("y", (height / 2 + 4).toFixed(1));
    this.counts.textContent = String(counts);
    move(this.element, x, bottom - height, tilt);
  }
}

function ramp(y: number): SVGPathElement {
  const left = SHAFT + PLATFORM + 6;
  return s("path", { d: `M${left} ${y}L620 ${y + 62}v8L${left} ${y + 8}z`, class: "metal" });
}

function count(x: number, y: number): SVGTextElement {
  return s("text", { x, y, "text-anchor": "end", class: "count" });
}

function tell(element: SVGElement, key: Key, value: number | undefined): void {
  element.textContent = value === undefined ? "" : t(key, value);
}

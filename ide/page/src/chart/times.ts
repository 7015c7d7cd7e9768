// The diagram of situations over time: a row for each step, filled while that is active. What it
// shows is the trail; a click goes to that moment.
import { button, h, s, select, setAttributes } from "../page/dom";
import { labelled } from "../panels/scope";
import { onLanguage, t } from "../text/language";
import type { Live, Row } from "./live";
import { savePng, saveSvg, settle, stemOf } from "./paper";

const SPANS = ["all", "1", "10", "60"] as const;
type Span = (typeof SPANS)[number];

/** In pixels: a row with its bar, the axis below, a letter of a name, least from mark to mark. */
const ROW = 20;
const BAR = 12;
const AXIS = 24;
const LETTER = 7.3;
const MARK = 80;
const WIDTH_MIN = 320;
/** From picture to picture, in milliseconds. */
const DRAW_MS = 150;

/** Where times are in a picture. */
interface Scale {
  left: number;
  right: number;
  from: number;
  to: number;
}

export class Times {
  private svg = s("svg", { role: "img" });
  private plot = h(
    "div",
    {
      class: "plot",
      label: "chartTimes",
      attributes: { role: "group", tabindex: 0 },
      on: {
        keydown: (event) => this.keys(event),
        pointerdown: (event) => this.point(event),
        pointermove: (event) => event.buttons === 1 && this.point(event),
      },
    },
    this.svg,
  );
  private span: Span = "all";
  private spans = select(
    "chartTimesWindow",
    SPANS.map((span) => [span, span === "all" ? "chartTimesAll" : { plain: `${span} s` }] as const),
    this.span,
    (span) => {
      this.span = span;
      this.draw();
    },
  );
  readonly element = h(
    "div",
    { class: "step-times", set: { hidden: true } },
    h(
      "div",
      { class: "controls" },
      labelled("chartTimesWindow", this.spans),
      button("chartTimesSvg", () => this.saveSvg()),
      button("chartTimesPng", () => void this.savePng()),
    ),
    this.plot,
  );
  private scale: Scale = { left: 0, right: 1, from: 0, to: 1 };
  private timer = 0;

  constructor(
    private live: Live,
    private shown: () => { only: number | null; file: string | null },
  ) {
    live.onChange(() => this.soon());
    onLanguage(() => this.draw());
    new ResizeObserver(() => this.soon()).observe(this.plot);
  }

  get isOpen(): boolean {
    return !this.element.hidden;
  }

  toggle(): void {
    this.element.hidden = this.isOpen;
    this.draw();
  }

  private soon(): void {
    if (this.timer !== 0 || !this.isOpen) return;
    this.timer = window.setTimeout(() => {
      this.timer = 0;
      this.draw();
    }, DRAW_MS);
  }

  private rows(): Row[] {
    const { only } = this.shown();
    return this.live.rows.filter(({ chart }) => only === null || chart === only);
  }

  /** Draws what is to be seen now. */
  draw(): void {
    if (!this.isOpen) return;
    const rows = this.rows();
    const left = 10 + LETTER * Math.max(4, ...rows.map(({ name }) => name.length));
    const width = Math.max(WIDTH_MIN, this.plot.clientWidth);
    const height = rows.length * ROW + AXIS;
    const [from, to] = this.range();
    this.scale = { left, right: width - 24, from, to };
    setAttributes(this.svg, { viewBox: `0 0 ${width} ${height}`, width, height });
    const [first, last] = [from, to].map((time) => (time / 1000).toFixed(3));
    this.svg.setAttribute("aria-label", t("chartTimesOf", first ?? "", last ?? ""));
    this.svg.replaceChildren(
      ...this.axis(height),
      ...rows.flatMap((row, at) => this.row(row, at)),
      ...this.cursor(height),
    );
  }

  /** The times that are shown. */
  private range(): [number, number] {
    const { moments, now, at, shown } = this.live.trail;
    const [first, last] = [moments[0]?.timeMs ?? 0, now?.timeMs ?? 1];
    if (this.span === "all") return [first, Math.max(last, first + 1)];
    const long = Number(this.span) * 1000;
    const end = at === null ? last : Math.min(last, (shown?.timeMs ?? last) + long / 2);
    return [end - long, end];
  }

  private x(time: number): number {
    const { left, right, from, to } = this.scale;
    const part = Math.min(1, Math.max(0, (time - from) / (to - from)));
    return left + part * (right - left);
  }

  private axis(height: number): SVGElement[] {
    const { left, right, from, to } = this.scale;
    const step = nice(((to - from) * MARK) / (right - left));
    const marks: SVGElement[] = [];
    const digits = Math.max(0, Math.ceil(-Math.log10(step / 1000)));
    for (let time = Math.ceil(from / step) * step; time <= to; time += step) {
      const x = this.x(time);
      marks.push(
        s("path", { d: `M${x} 0V${height - AXIS}`, class: "grid" }),
        s("text", { x, y: height - 8, class: "tick" }, `${(time / 1000).toFixed(digits)} s`),
      );
    }
    return marks;
  }

  private row({ name, chart, step }: Row, at: number): SVGElement[] {
    const y = at * ROW + ROW / 2;
    const { left, right } = this.scale;
    return [
      s("path", { d: `M${left} ${y + BAR / 2}H${right}`, class: "grid" }),
      s("text", { x: left - 6, y, class: "row-name" }, name),
      s("path", { d: this.bars(chart, step, y), class: "bar-on" }),
    ];
  }

  /** All times in which a step was active, those that touch in a picture as one. */
  private bars(chart: number, step: number, y: number): string {
    const { moments, now } = this.live.trail;
    const { from, to } = this.scale;
    const bars: [number, number][] = [];
    const begin = this.live.trail.atTime(from);
    for (let at = begin; at < moments.length; at += 1) {
      const moment = moments[at];
      if (!moment || moment.timeMs > to) break;
      if (!moment.steps[chart]?.[step]) continue;
      const end = moments[at + 1]?.timeMs ?? now?.timeMs ?? moment.timeMs;
      const [x, endX] = [this.x(moment.timeMs), this.x(end)];
      const last = bars.at(-1);
      if (last && x - last[1] < 0.5) last[1] = endX;
      else bars.push([x, endX]);
    }
    const top = y - BAR / 2;
    return bars.map(([x, end]) => `M${x} ${top}H${Math.max(end, x + 1)}v${BAR}H${x}z`).join("");
  }

  /** Where the moment is that is shown. */
  private cursor(height: number): SVGElement[] {
    const { at, shown } = this.live.trail;
    if (at === null || !shown) return [];
    const x = this.x(shown.timeMs);
    return [s("path", { d: `M${x} 0V${height - AXIS}`, class: "cursor" })];
  }

  /** Goes to the moment that is pointed at. */
  private point({ clientX }: PointerEvent): void {
    const { left, right, from, to } = this.scale;
    const x = clientX - this.svg.getBoundingClientRect().left;
    if (x < left) return;
    const time = from + ((x - left) / (right - left)) * (to - from);
    this.live.go((trail) => trail.goTo(time > to ? -1 : trail.atTime(time)));
  }

  /** Arrows go to the moment before, or the next one. */
  private keys(event: KeyboardEvent): void {
    const by = event.key === "ArrowLeft" ? -1 : event.key === "ArrowRight" ? 1 : 0;
    if (by === 0) return;
    event.preventDefault();
    this.live.go((trail) => trail.go(by));
  }

  private made(): { svg: SVGSVGElement; name: string } {
    this.draw();
    const svg = this.svg.cloneNode(true) as SVGSVGElement;
    const { width, height } = this.svg.viewBox.baseVal;
    svg.prepend(s("rect", { width, height, fill: "#ffffff" }));
    const file = stemOf(this.shown().file ?? "chart");
    return { svg: settle(svg, this.plot, ""), name: `${file}-${t("chartTimesFile")}` };
  }

  saveSvg(): void {
    const { svg, name } = this.made();
    saveSvg(svg, name);
  }

  async savePng(): Promise<void> {
    const { svg, name } = this.made();
    await savePng(svg, name);
  }
}

/** The least of 1, 2, 5, 10 and so on that is not less. */
function nice(least: number): number {
  const power = 10 ** Math.floor(Math.log10(least));
  const factor = [1, 2, 5].find((one) => one * power >= least) ?? 10;
  return Math.max(1, factor * power);
}

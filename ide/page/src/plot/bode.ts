// A Bode plot: gain and phase over the logarithm of the frequency, each with a point for each
// frequency.
import uPlot from "uplot";
import type { FrequencyResponse } from "../core/protocol";
import { h } from "../page/dom";
import { colour, onTheme } from "../page/theme";
import { t, type Key } from "../text/language";

const HEIGHT = 190;
const AXIS_WIDTH = 62;
/** A band that has more powers of ten than two is labelled at them only. */
const WIDE = 150;
const CURVES = [
  { column: "gains", caption: "sweepGain", stroke: "signal-1" },
  {
    column: "phases",
    caption: "sweepPhase",
    stroke: "signal-2",
    steps: [1, 5, 15, 30, 45, 90, 180, 360, 720],
  },
] as const satisfies {
  column: keyof FrequencyResponse;
  caption: Key;
  stroke: string;
  steps?: number[];
}[];

export class Bode {
  readonly element = h("div", { class: "plots" });
  private plots: uPlot[] = [];
  private response: FrequencyResponse | undefined;

  /** `pointed` is told which frequency the pointer is at; null: at none. */
  constructor(private pointed: (index: number | null) => void) {
    onTheme(() => this.rebuild());
    new ResizeObserver(() => {
      for (const plot of this.plots) plot.setSize({ width: this.width(), height: HEIGHT });
    }).observe(this.element);
  }

  draw(response: FrequencyResponse): void {
    this.response = response;
    this.rebuild();
  }

  private rebuild(): void {
    for (const plot of this.plots) plot.destroy();
    this.element.replaceChildren();
    const { response } = this;
    if (response) this.plots = CURVES.map((curve) => this.plot(response, curve));
  }

  private width(): number {
    return Math.max(200, this.element.clientWidth);
  }

  private plot(response: FrequencyResponse, curve: (typeof CURVES)[number]): uPlot {
    const caption = t(curve.caption);
    const holder = h("figure", { class: "strip" }, h("figcaption", {}, caption));
    this.element.append(holder);
    const { frequencies } = response;
    const [low, high] = [frequencies[0] ?? 1, frequencies.at(-1) ?? 10];
    // Between the powers of ten where there is room.
    const shown = high / low > WIDE ? [1] : [1, 2, 5];
    const axis = { stroke: colour("muted"), grid: { stroke: colour("grid"), width: 1 } };
    return new uPlot(
      {
        width: this.width(),
        height: HEIGHT,
        padding: [8, 22, 2, 0],
        legend: { show: false },
        scales: { x: { time: false, distr: 3, range: [low, high] } },
        axes: [
          {
            ...axis,
            filter: (_, splits) =>
              splits.map((split) => (shown.includes(digit(split)) ? split : null)),
            values: (_, splits) =>
              splits.map((split) => (split === null ? "" : `${Number(split.toPrecision(3))} Hz`)),
          },
          { ...axis, size: AXIS_WIDTH, ...("steps" in curve ? { incrs: [...curve.steps] } : {}) },
        ],
        series: [
          {},
          {
            label: caption,
            stroke: colour(curve.stroke),
            width: 2,
            points: { show: true, size: 5 },
          },
        ],
        cursor: { y: false, drag: { x: false, y: false }, sync: { key: "uno200-bode" } },
        hooks: { setCursor: [(plot) => this.pointed(plot.cursor.idx ?? null)] },
      },
      [frequencies, response[curve.column]],
      holder,
    );
  }
}

/** The first digit of a line of the axis, which is a round number. */
function digit(hertz: number): number {
  return Math.round(hertz / 10 ** Math.floor(Math.log10(hertz) + 1e-9));
}

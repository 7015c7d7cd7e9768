// Signals over time: a strip for each, steps held until the next sample, two cursors.
import uPlot from "uplot";
import { h } from "../page/dom";
import { colour, onTheme } from "../page/theme";
import { lastAt } from "./samples";

export type Column = (number | null)[];

/** Samples as they are drawn: times in milliseconds, null where none could be taken. */
export interface Data {
  times: number[];
  columns: Column[];
}

export type CursorName = "A" | "B";
export type Cursors = Record<CursorName, number | null>;

const BIT_HEIGHT = 46;
const NUMBER_HEIGHT = 104;
const AXIS_HEIGHT = 34;
const AXIS_WIDTH = 62;
/** Colours of the style sheet for signals. */
const COLOURS = 8;

export class Plots {
  readonly element = h("div", { class: "plots" });
  cursors: Cursors = { A: null, B: null };
  /** Is told when a cursor was moved here. */
  cursorMoved: () => void = () => {};
  private plots: uPlot[] = [];
  private names: string[] = [];
  private data: Data = { times: [], columns: [] };
  private range: [number, number] = [0, 1];
  private areBits: boolean[] = [];
  private trigger: number | null = null;

  constructor() {
    onTheme(() => this.rebuild());
    new ResizeObserver(() => this.resize()).observe(this.element);
  }

  /** Draws samples; strips are made anew when the signals are other ones. */
  draw(
    names: string[],
    data: Data,
    rangeMs: [number, number],
    trigger: number | null = null,
  ): void {
    const areBits = data.columns.map(isBits);
    const isSame = same(names, this.names) && same(areBits, this.areBits);
    this.names = names;
    this.areBits = areBits;
    this.data = data;
    this.range = [rangeMs[0] / 1000, Math.max(rangeMs[1], rangeMs[0] + 1) / 1000];
    this.trigger = trigger;
    if (isSame) this.fill();
    else this.rebuild();
  }

  /** Draws the cursors where they are now. */
  redraw(): void {
    for (const plot of this.plots) plot.redraw(false);
  }

  /** The values at a cursor: those of the last sample before it. */
  valuesAt(time: number): (number | null)[] {
    const at = lastAt(this.data.times, time);
    return this.data.columns.map((column) => (at < 0 ? null : (column[at] ?? null)));
  }

  /** A picture of all strips, with names. */
  picture(): HTMLCanvasElement {
    const canvases = this.plots.map((plot) => plot.ctx.canvas);
    const picture = document.createElement("canvas");
    const title = 18 * devicePixelRatio;
    picture.width = Math.max(1, ...canvases.map((canvas) => canvas.width));
    picture.height = canvases.reduce((sum, canvas) => sum + canvas.height + title, 0);
    const context = picture.getContext("2d");
    if (!context) return picture;
    context.fillStyle = colour("surface");
    context.fillRect(0, 0, picture.width, picture.height);
    context.font = `${12 * devicePixelRatio}px sans-serif`;
    let top = 0;
    for (const [index, canvas] of canvases.entries()) {
      context.fillStyle = colour("text");
      context.fillText(this.names[index] ?? "", 6 * devicePixelRatio, top + title * 0.75);
      context.drawImage(canvas, 0, top + title);
      top += title + canvas.height;
    }
    return picture;
  }

  private rebuild(): void {
    for (const plot of this.plots) plot.destroy();
    this.element.replaceChildren();
    this.plots = this.names.map((name, index) => this.strip(name, index));
    this.fill();
  }

  private fill(): void {
    const [min, max] = this.range;
    const seconds = this.data.times.map((time) => time / 1000);
    for (const [index, plot] of this.plots.entries()) {
      plot.setData([seconds, this.data.columns[index] ?? []], false);
      plot.setScale("x", { min, max });
    }
  }

  private resize(): void {
    for (const [index, plot] of this.plots.entries())
      plot.setSize({ width: this.width(), height: this.height(index) });
  }

  private width(): number {
    return Math.max(200, this.element.clientWidth);
  }

  private height(index: number): number {
    const isLast = index === this.names.length - 1;
    return (this.areBits[index] ? BIT_HEIGHT : NUMBER_HEIGHT) + (isLast ? AXIS_HEIGHT : 0);
  }

  private strip(name: string, index: number): uPlot {
    const holder = h("figure", { class: "strip" }, h("figcaption", {}, name));
    this.element.append(holder);
    const isBit = this.areBits[index] ?? false;
    const isLast = index === this.names.length - 1;
    const stroke = colour(`signal-${(index % COLOURS) + 1}`);
    const text = colour("muted");
    const grid = { stroke: colour("grid"), width: 1 };
    const steps = uPlot.paths.stepped?.({ align: 1 });
    const plot = new uPlot(
      {
        width: this.width(),
        height: this.height(index),
        padding: [4, 12, 2, 0],
        legend: { show: false },
        scales: {
          x: { time: false, auto: false },
          y: isBit ? { range: [-0.2, 1.2] } : { range: roomy },
        },
        axes: [
          {
            stroke: text,
            grid,
            ticks: { show: false },
            size: isLast ? AXIS_HEIGHT : 0,
            values: (_, splits) => splits.map((split) => (isLast ? `${round(split)} s` : "")),
          },
          {
            stroke: text,
            grid: isBit ? { show: false } : grid,
            ticks: { show: false },
            size: AXIS_WIDTH,
            ...(isBit ? { splits: [0, 1] } : {}),
            values: (_, splits) => splits.map((split) => String(round(split))),
          },
        ],
        series: [
          {},
          {
            label: name,
            stroke,
            width: 2,
            points: { show: false },
            spanGaps: false,
            ...(isBit ? { fill: `${stroke}33` } : {}),
            ...(steps ? { paths: steps } : {}),
          },
        ],
        cursor: { y: false, drag: { x: false, y: false }, sync: { key: "uno200" } },
        hooks: { draw: [(plot) => this.drawCursors(plot)] },
      },
      [[], []],
      holder,
    );
    plot.over.addEventListener("pointerdown", (event) => this.place(plot, event));
    return plot;
  }

  /** A click puts cursor A, with Shift cursor B. */
  private place(plot: uPlot, event: PointerEvent): void {
    const left = event.clientX - plot.over.getBoundingClientRect().left;
    this.cursors[event.shiftKey ? "B" : "A"] = plot.posToVal(left, "x") * 1000;
    this.redraw();
    this.cursorMoved();
  }

  private drawCursors(plot: uPlot): void {
    const { A, B } = this.cursors;
    for (const [name, time] of [
      ["A", A],
      ["B", B],
      ["T", this.trigger],
    ] as const)
      if (time !== null) drawLine(plot, time / 1000, name);
  }
}

function drawLine(plot: uPlot, at: number, name: string): void {
  const { ctx, bbox } = plot;
  const x = Math.round(plot.valToPos(at, "x", true));
  if (x < bbox.left || x > bbox.left + bbox.width) return;
  ctx.save();
  ctx.strokeStyle = ctx.fillStyle = colour(name === "T" ? "warning" : "text");
  ctx.font = `${11 * devicePixelRatio}px sans-serif`;
  ctx.textAlign = "left";
  ctx.textBaseline = "top";
  ctx.setLineDash(name === "A" ? [] : [5, 4]);
  ctx.beginPath();
  ctx.moveTo(x, bbox.top);
  ctx.lineTo(x, bbox.top + bbox.height);
  ctx.stroke();
  ctx.fillText(name, x + 4 * devicePixelRatio, bbox.top + 1);
  ctx.restore();
}

function isBits(column: Column): boolean {
  return column.every((value) => value === null || value === 0 || value === 1);
}

function same(one: readonly unknown[], other: readonly unknown[]): boolean {
  return one.length === other.length && one.every((value, index) => value === other[index]);
}

/** Some room above and below, and a range even where nothing changes. */
function roomy(_: uPlot, min: number | null, max: number | null): [number, number] {
  const [low, high] = [min ?? 0, max ?? 1];
  const room = (high - low || Math.abs(high) || 1) * 0.08;
  return [low - room, high + room];
}

function round(value: number): number {
  return Number(value.toPrecision(6));
}

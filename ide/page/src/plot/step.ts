// The figures of a step response. Values are held until the next sample, as they are drawn; what
// cannot be known from the samples is null.
import type { Column } from "./plots";
import { lastAt } from "./samples";

/** So much of the step is the way up: from 10 % to 90 %. */
const RISE = [0.1, 0.9] as const;
/** Settled is what stays so near to its last value, as a part of the step. */
const BAND = 0.02;
/** The value after the step is the mean of this last part of the time. */
const LAST = 0.1;
/** In this last part it must have settled. */
const REST = 0.2;
/** A difference that is less than this part of a value is none: a REAL has no more digits. */
const NONE = 1e-6;

/** A signal and its set value: another signal, a number, or none. Times are in milliseconds. */
export interface Recorded {
  times: number[];
  signal: Column;
  wanted: Column | number | null;
}

/**
 * `step`: it has all figures that the samples give; `constant`: the value after is the one before;
 * `restless`: it has not settled; `nothing`: there are too few samples.
 */
export type Kind = "step" | "constant" | "restless" | "nothing";

/** Times are in seconds, the overshoot is in percent of the step. */
export interface Response {
  kind: Kind;
  begin: number | null;
  before: number | null;
  after: number | null;
  rise: number | null;
  overshoot: number | null;
  settling: number | null;
  /** Set value minus value after. */
  steadyError: number | null;
  /** Integral of the absolute error over time; without a set value that to the value after. */
  iae: number | null;
  /** So much of the time there are no samples: it is in no figure. */
  missing: number;
}

/** A value from a time to another one, in seconds. */
interface Piece {
  from: number;
  to: number;
  value: number | null;
  wanted: number | null;
}

/** The figures of what is in a range of times, in milliseconds. */
export function stepResponse(recorded: Recorded, range: readonly [number, number]): Response {
  const all = pieces(recorded, range);
  const first = Math.max(0, lastChange(all));
  const answer = all.slice(first);
  const end = answer.at(-1)?.to ?? 0;
  const begin = answer[0]?.from ?? 0;
  const before = valueBefore(all, first);
  const after = mean(answer, end - LAST * (end - begin));
  const response: Response = { ...NOTHING, missing: missing(answer) };
  if (before === null || after === null) return response;
  const step = new Step(answer, begin, end, before, after);
  const wanted = answer.findLast((piece) => piece.wanted !== null)?.wanted ?? null;
  response.begin = begin;
  response.before = before;
  response.kind = step.kind();
  const isSettled = response.kind !== "restless";
  response.iae = integral(answer, wanted !== null ? null : isSettled ? after : undefined);
  if (!isSettled) return response;
  response.after = after;
  if (wanted !== null) response.steadyError = wanted - after;
  if (response.kind === "constant") return response;
  response.rise = step.rise();
  response.overshoot = step.overshoot();
  response.settling = step.settling();
  return response;
}

const NOTHING: Response = {
  kind: "nothing",
  begin: null,
  before: null,
  after: null,
  rise: null,
  overshoot: null,
  settling: null,
  steadyError: null,
  iae: null,
  missing: 0,
};

/** What is in the range; the sample before it reaches into it. */
function pieces({ times, signal, wanted }: Recorded, [from, to]: readonly [number, number]) {
  const found: Piece[] = [];
  for (let at = Math.max(0, lastAt(times, from)); at < times.length; at += 1) {
    const time = Math.max(from, times[at] ?? 0);
    if (time > to) break;
    found.push({
      from: time / 1000,
      to: Math.min(to, Math.max(time, times[at + 1] ?? time)) / 1000,
      value: signal[at] ?? null,
      wanted: typeof wanted === "number" ? wanted : (wanted?.[at] ?? null),
    });
  }
  return found;
}

/** The index of the piece with which the set value has its last value; -1 where it never changes. */
function lastChange(pieces: Piece[]): number {
  let last: number | null = null;
  let found = -1;
  for (const [index, { wanted }] of pieces.entries()) {
    if (wanted === null) continue;
    if (last !== null && wanted !== last) found = index;
    last = wanted;
  }
  return found;
}

/** The last one before the step begins: with its first sample the signal may have answered. */
function valueBefore(pieces: Piece[], first: number): number | null {
  const isKnown = ({ value }: Piece) => value !== null;
  const before = pieces.slice(0, first).findLast(isKnown) ?? pieces.slice(first).find(isKnown);
  return before?.value ?? null;
}

/** The mean from a time on, each value with the time for which it is held. */
function mean(pieces: Piece[], begin: number): number | null {
  let [sum, time] = [0, 0];
  for (const { from, to, value } of pieces) {
    const length = to - Math.max(from, begin);
    if (value === null || length <= 0) continue;
    sum += value * length;
    time += length;
  }
  return time > 0 ? sum / time : null;
}

function missing(pieces: Piece[]): number {
  const gaps = pieces.filter(({ value }) => value === null);
  return gaps.reduce((sum, { from, to }) => sum + to - from, 0);
}

/** To a value, or to the set value of each piece (null); to none there is no integral. */
function integral(pieces: Piece[], value: number | null | undefined): number | null {
  if (value === undefined) return null;
  let sum = 0;
  for (const piece of pieces) {
    const wanted = value ?? piece.wanted;
    if (piece.value === null || wanted === null) continue;
    sum += Math.abs(wanted - piece.value) * (piece.to - piece.from);
  }
  return sum;
}

/** A step from a value to another one, as if it rose from 0 to its size. */
class Step {
  private size: number;
  private none: number;
  private rest: number;

  constructor(
    private pieces: Piece[],
    private begin: number,
    end: number,
    before: number,
    private after: number,
  ) {
    this.size = after - before;
    this.none = NONE * Math.max(Math.abs(before), Math.abs(after));
    this.rest = end - REST * (end - begin);
  }

  kind(): Kind {
    const isNear = (piece: Piece) => piece.to <= this.rest || !this.isOutside(piece);
    if (!this.pieces.every(isNear)) return "restless";
    return Math.abs(this.size) > this.none ? "step" : "constant";
  }

  private isOutside({ value }: Piece): boolean {
    const band = Math.max(BAND * Math.abs(this.size), this.none);
    return value !== null && Math.abs(value - this.after) > band;
  }

  /** From 10 % to 90 %; null where one of both was reached in a gap. */
  rise(): number | null {
    const [low, high] = RISE.map((part) => this.reached(part));
    return low == null || high == null ? null : high - low;
  }

  /** When a part of the step is reached for the first time. */
  private reached(part: number): number | null {
    const isThere = ({ value }: Piece) => value !== null && this.part(value) >= part;
    return this.known(this.pieces.findIndex(isThere));
  }

  private part(value: number): number {
    return 1 + (value - this.after) / this.size;
  }

  /** When a piece begins; null if what was right before it is not known. */
  private known(index: number): number | null {
    if (index > 0 && this.pieces[index - 1]?.value === null) return null;
    return this.pieces[index]?.from ?? null;
  }

  /** In percent; what the value after is taken from is not beyond itself. */
  overshoot(): number {
    const moving = this.pieces.filter(({ from }) => from < this.rest);
    const parts = moving.flatMap(({ value }) => (value === null ? [] : [this.part(value)]));
    return 100 * parts.reduce((most, part) => Math.max(most, part - 1), 0);
  }

  /** From the beginning until it is near for good. */
  settling(): number | null {
    const last = this.pieces.findLastIndex((piece) => this.isOutside(piece));
    const next = this.pieces[last + 1];
    return next === undefined || next.value === null ? null : next.from - this.begin;
  }
}

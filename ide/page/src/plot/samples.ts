// Samples as they come, the last ones of them. Where some were lost there is a gap.
import type { Column, Data } from "./plots";

/** Samples of each signal that are kept. */
const KEPT_MAX = 60_000;

export class Samples {
  times: number[] = [];
  columns: Column[] = [];
  /** How often some were lost. */
  losses = 0;

  constructor(private count: number) {
    this.columns = Array.from({ length: count }, () => []);
  }

  /** Takes more; samples of other signals, asked for before, are not taken. */
  add(times: number[], columns: number[][], isLost: boolean): void {
    if (columns.length !== this.count) return;
    const first = times[0];
    const last = this.times.at(-1);
    // The PLC's time began anew: what was before has no place on this axis.
    if (first !== undefined && last !== undefined && first < last) this.clear();
    if (isLost) this.losses += 1;
    if (isLost && first !== undefined && this.times.length > 0) {
      this.times.push(first);
      for (const column of this.columns) column.push(null);
    }
    for (const time of times) this.times.push(time);
    for (const [index, column] of this.columns.entries())
      for (const value of columns[index] ?? []) column.push(value);
    if (this.times.length > 2 * KEPT_MAX) this.drop(this.times.length - KEPT_MAX);
  }

  private drop(count: number): void {
    this.times.splice(0, count);
    for (const column of this.columns) column.splice(0, count);
  }

  clear(): void {
    this.times = [];
    this.columns = this.columns.map(() => []);
    this.losses = 0;
  }

  /** Those of a range of times, with the one before it: its step reaches into the range. */
  within(from: number, to: number): Data {
    const begin = Math.max(
      0,
      this.times.findLastIndex((time) => time <= from),
    );
    const after = this.times.findIndex((time) => time > to);
    const end = after < 0 ? this.times.length : after;
    return {
      times: this.times.slice(begin, end),
      columns: this.columns.map((column) => column.slice(begin, end)),
    };
  }
}

/** The index of the last time that is not after `time`; -1 for none. */
export function lastAt(times: number[], time: number): number {
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((times[middle] ?? 0) <= time) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

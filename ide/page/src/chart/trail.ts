// The moments that charts were in, as they were told: what is shown of them, and for how long a step
// was active. How they are drawn is not known here.
import type { Moment } from "../core/protocol";

/** So many are kept, and so many states of steps and values in all of them: the oldest ones go. */
const MOMENTS_MAX = 20_000;
const CELLS_MAX = 2_000_000;
/** The part that goes when there is no room. */
const GONE = 0.1;

/** For how long a step has been active; at least so long if it was before the first moment. */
export interface Lasting {
  ms: number;
  isLeast: boolean;
}

export class Trail {
  moments: Moment[] = [];
  now: Moment | null = null;
  /** The number of the moment that is shown; null: as it is now. */
  at: number | null = null;
  /** How often some are missing. */
  losses = 0;

  clear(): void {
    Object.assign(this, { moments: [], now: null, at: null, losses: 0 });
  }

  /** Takes in what was told. */
  add(before: Moment[], now: Moment, isLossy: boolean): void {
    const last = this.moments.at(-1);
    const first = before[0] ?? now;
    if (last && (first.timeMs < last.timeMs || !isAlike(first, last))) this.clear();
    if (isLossy) {
      this.losses += 1;
      this.miss();
    }
    for (const moment of [...before, now]) this.push(moment);
    this.now = now;
    this.makeRoom();
  }

  /** Nothing is known from now on. */
  miss(): void {
    const last = this.now ?? this.moments.at(-1);
    if (!last) return;
    const unknown = (steps: unknown[]) => steps.map(() => null);
    this.push({ ...last, steps: last.steps.map(unknown), values: unknown(last.values) });
  }

  private push(moment: Moment): void {
    const last = this.moments.at(-1);
    if (!last || !isSame(moment.steps, last.steps)) this.moments.push(moment);
  }

  private makeRoom(): void {
    const { moments, now } = this;
    const cells = (now?.steps.flat().length ?? 0) + (now?.values.length ?? 0);
    const most = Math.min(MOMENTS_MAX, CELLS_MAX / Math.max(1, cells));
    if (moments.length <= most) return;
    const gone = Math.ceil(moments.length - most * (1 - GONE));
    moments.splice(0, gone);
    if (this.at !== null) this.at = Math.max(0, this.at - gone);
  }

  /** The one that is shown. */
  get shown(): Moment | null {
    return this.at === null ? this.now : (this.moments[this.at] ?? null);
  }

  private get index(): number {
    return this.at ?? this.moments.length - 1;
  }

  /** The one before that. */
  get before(): Moment | null {
    return this.moments[this.index - 1] ?? null;
  }

  /** Whether there is one to go to. */
  canGo(by: 1 | -1): boolean {
    return by < 0 ? this.index > 0 : this.at !== null;
  }

  /** Goes to the next one, or the one before; after the last one it is as now. */
  go(by: 1 | -1): void {
    if (this.canGo(by)) this.goTo(this.index + by);
  }

  /** Goes to a moment; beyond the last one to now. */
  goTo(at: number): void {
    const isThere = at >= 0 && at < this.moments.length;
    this.at = isThere ? at : null;
  }

  /** The number of the last moment that is not after a time. */
  atTime(timeMs: number): number {
    let [low, high] = [0, this.moments.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((this.moments[middle]?.timeMs ?? 0) <= timeMs) low = middle + 1;
      else high = middle;
    }
    return Math.max(0, low - 1);
  }

  /** For how long a step has been active at the moment that is shown; null if it is not. */
  lasting(chart: number, step: number): Lasting | null {
    const { shown, moments } = this;
    if (!shown?.steps[chart]?.[step]) return null;
    let at = this.index;
    while (at > 0 && moments[at - 1]?.steps[chart]?.[step]) at -= 1;
    const ms = shown.timeMs - (moments[at]?.timeMs ?? shown.timeMs);
    const isLeast = at === 0 || moments[at - 1]?.steps[chart]?.[step] === null;
    return { ms, isLeast };
  }
}

type Steps = Moment["steps"];

function isSame(one: Steps, other: Steps): boolean {
  return one.every((steps, chart) => steps.every((step, at) => step === other[chart]?.[at]));
}

/** Whether they are of the same charts. */
function isAlike(one: Moment, other: Moment): boolean {
  return (
    one.steps.map(({ length }) => length).join() === other.steps.map(({ length }) => length).join()
  );
}

/** A time as it is read. */
export function seconds(ms: number): string {
  return `${(ms / 1000).toFixed(ms < 10_000 ? 2 : 1)} s`;
}

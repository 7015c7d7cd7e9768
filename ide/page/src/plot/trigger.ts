// Finds the sample at which a signal does what is waited for.
import type { Column } from "./plots";

export const EDGES = ["none", "rising", "falling", "above", "below"] as const;
export type Edge = (typeof EDGES)[number];

export interface Trigger {
  edge: Edge;
  /** Which signal, from 0. */
  signal: number;
  level: number;
}

/**
 * The index of the first sample from `begin` on at which it happens; -1 for none. `rising` and
 * `falling` cross the level, `above` and `below` are on that side of it. A sample after a gap
 * crosses nothing: what was before it is not known.
 */
export function find({ edge, level }: Trigger, column: Column, begin: number): number {
  for (let at = Math.max(0, begin); at < column.length; at += 1) {
    const now = column[at] ?? null;
    const before = at > 0 ? (column[at - 1] ?? null) : null;
    if (now !== null && happens(edge, level, before, now)) return at;
  }
  return -1;
}

function happens(edge: Edge, level: number, before: number | null, now: number): boolean {
  switch (edge) {
    case "none":
      return false;
    case "above":
      return now >= level;
    case "below":
      return now <= level;
    case "rising":
      return before !== null && before < level && now >= level;
    case "falling":
      return before !== null && before >= level && now < level;
  }
}

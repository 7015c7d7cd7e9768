// What is read beside a step that is active: its time; and beside a transition that is enabled:
// whether its condition is TRUE, what it waits for, and the values of its variables.
import { t } from "../text/language";
import type { Point } from "./drawn";
import type { Judged } from "./judging";
import type { ChartOperand, ChartStep, ChartTransition } from "./protocol";
import { seconds } from "./trail";

export interface Note {
  /** Where it begins, on the middle line of its first line. */
  at: Point;
  /** As drawn, line by line, and all of it. */
  lines: string[];
  all: string;
  /** What readers of screens are told with the name; values change too often for that. */
  said: string;
  isGood: boolean;
}

/** Longer lines end in dots. */
const LETTERS_MAX = 48;

/** The note of a step: its time, above its right half. */
export function timeOf({ frame: [x, y, width] }: ChartStep, time: string): Note {
  const at = [x + width / 2 + 8, y - 8] as const;
  return { at, lines: [time], all: time, said: "", isGood: true };
}

/** The note of a transition whose condition was judged; none where nothing is known. */
export function noteOf({ operands }: ChartTransition, judged: Judged, at: Point): Note | null {
  const { isTrue, waitsFor, values } = judged;
  const known = operands.map((operand, at) => valueOf(operand, values[at] ?? null));
  // What is TRUE or FALSE the condition says by itself.
  const numbers = known.filter((_, at) => operands[at]?.kind !== "truth");
  const said = isTrue === null ? "" : isTrue ? t("chartTrue") : t("chartWaits", waitsFor);
  const lines = [isTrue ? "✓ TRUE" : said, numbers.filter(Boolean).join(" · ")];
  const all = [said, ...known].filter(Boolean).join("\n");
  if (all === "") return null;
  return { at, lines: lines.filter(Boolean).map(short), all, said, isGood: isTrue === true };
}

function valueOf({ written, kind }: ChartOperand, value: number | null): string {
  if (value === null) return "";
  if (kind === "truth") return `${written} = ${value === 0 ? "FALSE" : "TRUE"}`;
  const shown = kind === "time" ? seconds(value) : String(Number(value.toPrecision(7)));
  return `${written} = ${shown}`;
}

function short(words: string): string {
  return words.length > LETTERS_MAX ? `${words.slice(0, LETTERS_MAX - 1)}…` : words;
}

// How an action of a block is written in one line: `Motor`, `L T#2s Motor`, and back.
import type { Wanted } from "./protocol";

/** Those that have a time, and those that have none. */
const TIMED = ["L", "D", "SD", "DS", "SL"];
const UNTIMED = ["N", "P", "P0", "P1", "S", "R"];
const QUALIFIER = new RegExp(`^(${[...TIMED, ...UNTIMED].join("|")})\\s+(\\S[^]*)$`, "i");
/** A time, then the action with what belongs to it. */
const WITH_TIME = /^(\S.*?)\s+([A-Za-z_%][\w.%]*(?:\s*\{[^]*\})*)$/;

/** What a line means; what it lacks, the module of charts says. */
export function wanted(line: string): Wanted {
  const [, qualifier, rest] = QUALIFIER.exec(line.trim()) ?? [];
  if (!qualifier || !rest) return { qualifier: "N", time: null, action: line.trim() };
  const name = qualifier.toUpperCase();
  const [, time, action] = (TIMED.includes(name) && WITH_TIME.exec(rest)) || [];
  const isTimed = time !== undefined && action !== undefined;
  return {
    qualifier: name,
    time: isTimed ? time : null,
    action: isTimed ? action : rest,
  };
}

/** The line of an action. */
export function line({ qualifier, time, action }: Wanted): string {
  const isPlain = qualifier === "N" && !QUALIFIER.test(action);
  return [isPlain ? null : qualifier, time, action].filter(Boolean).join(" ");
}

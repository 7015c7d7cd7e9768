// What parts of the page want to know of the target all the time: each has a list of its own, and
// gets the values of that.
import type { Core } from "./core";
import type { Value } from "./protocol";

interface Part {
  operands: readonly string[];
  take: (values: Value[]) => void;
}

export class Watching {
  private parts: Part[] = [];

  constructor(private core: Core) {
    core.on("watched", ({ values }) => this.take(values));
  }

  /** A part with what takes its values, in the order of its list; gives what sets that. */
  part(take: (values: Value[]) => void): (operands: readonly string[]) => void {
    const part: Part = { operands: [], take };
    this.parts.push(part);
    return (operands) => {
      if (operands.join() === part.operands.join()) return;
      part.operands = operands;
      this.core.tell({ do: "watch", operands: this.parts.flatMap((one) => one.operands) });
    };
  }

  private take(values: Value[]): void {
    const operands = this.parts.flatMap((one) => one.operands);
    // Otherwise it is an answer to the lists as they were before.
    if (operands.length !== values.length) return;
    if (operands.some((operand, at) => operand !== values[at]?.name)) return;
    let from = 0;
    for (const part of this.parts) {
      const to = from + part.operands.length;
      if (to > from) part.take(values.slice(from, to));
      from = to;
    }
  }
}

// The values of pins and parameters that can be seen, as the target tells them.
import type { Value } from "../core/protocol";
import type { Watching } from "../core/watching";
import type { Operands } from "../panels/operands";

/** Something with a value: what that may be called in the program. */
export interface Named {
  names: string[];
}

export class Live {
  /** Whether the target tells of the program; otherwise nothing is known. */
  isAlive = false;
  private values = new Map<string, Value>();
  private names: readonly string[] = [];
  private known = new Map<string, string>();
  private ask: (operands: readonly string[]) => void;

  constructor(
    watching: Watching,
    private operands: Operands,
    changed: () => void,
  ) {
    this.ask = watching.part((values) => {
      this.values = new Map(values.map((value) => [value.name, value]));
      changed();
    });
  }

  /** Asks for the values of these alone. */
  want(named: Named[]): void {
    this.learn();
    this.ask([...new Set(named.flatMap((one) => this.nameOf(one) ?? []))]);
  }

  /** The value of each of these, as far as it is known. */
  of(named: Named[]): (Value | undefined)[] {
    if (!this.isAlive) return named.map(() => undefined);
    this.learn();
    return named.map((one) => {
      const name = this.nameOf(one);
      const value = name === undefined ? undefined : this.values.get(name);
      return value && value.problem === null && value.text !== "" ? value : undefined;
    });
  }

  /** The names in the program, as it is now. */
  private learn(): void {
    const { names } = this.operands;
    if (names === this.names) return;
    this.names = names;
    this.known = new Map(names.map((name) => [name.toLowerCase(), name]));
  }

  /** What it is called in the program. */
  private nameOf({ names }: Named): string | undefined {
    const found = names.map((name) => this.known.get(name.toLowerCase())).find((name) => name);
    // An address is what it is called, and is not among the names.
    return found ?? (names.length === 1 ? names[0] : undefined);
  }
}

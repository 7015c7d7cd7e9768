// Parts of a drawing that a keyboard walks through: one has the focus or gets it by Tab, arrows lead
// to the others. What the drawing is, is not known here.

/** A part that is drawn. */
export interface Part {
  /** All of it. */
  readonly group: SVGGElement;
  /** What has the focus and the name. */
  readonly button: SVGGElement;
}

/** Where a key leads from a place in a row; not where it is no key for that. */
export function goalOf(key: string, at: number, count: number): number | undefined {
  const goals: Record<string, number> = {
    ArrowRight: at + 1,
    ArrowDown: at + 1,
    ArrowLeft: at - 1,
    ArrowUp: at - 1,
    Home: 0,
    End: count - 1,
  };
  return goals[key];
}

export class Walk<P extends Part> {
  constructor(
    private within: HTMLElement,
    private parts: () => P[],
  ) {}

  /** The drawing is a new one: Tab leads to its first part. */
  begin(): void {
    this.parts()[0]?.button.setAttribute("tabindex", "0");
  }

  /** The part that an event is about. */
  at(target: EventTarget | null): P | undefined {
    return this.parts().find(({ group }) => target instanceof Node && group.contains(target));
  }

  focus(part: P): void {
    for (const { button } of this.parts()) button.setAttribute("tabindex", "-1");
    part.button.setAttribute("tabindex", "0");
    part.button.focus();
  }

  /** Scrolls to a part, unless somebody walks elsewhere. */
  reveal(part: P | undefined): void {
    if (this.within.contains(document.activeElement)) return;
    part?.group.scrollIntoView({ block: "nearest", inline: "nearest" });
  }

  /** A key on a part: goes to another one, or, where it is no key for that, has `act` do something
   * with this one; whether it did. */
  keys(event: KeyboardEvent, act: (part: P) => boolean): void {
    const part = this.at(event.target);
    if (!part || event.altKey || event.ctrlKey || event.metaKey) return;
    const parts = this.parts();
    const goal = goalOf(event.key, parts.indexOf(part), parts.length);
    if (goal !== undefined) {
      const next = parts[goal];
      if (next) this.focus(next);
    } else if (!act(part)) return;
    event.preventDefault();
  }
}

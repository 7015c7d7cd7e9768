// Whether conditions of transitions are TRUE: has the module of charts judge them, one question after
// the other, always with the last values.
import type { ChartDocument } from "./document";
import type { TransitionItem } from "./drawn";
import type { Judgement } from "./protocol";

/** A transition with the values in its condition. */
interface Wanted {
  item: TransitionItem;
  values: (number | null)[];
}
/** What came of it. */
export type Judged = Judgement & { values: (number | null)[] };

export class Judging {
  private judged = new Map<string, Judged>();
  private asked = "";
  private wanted: { transitions: Wanted[]; reading: number } | null = null;
  private isAsking = false;

  constructor(
    private document: ChartDocument,
    private changed: () => void,
  ) {}

  forget(): void {
    this.judged.clear();
    this.asked = "";
  }

  of({ key }: TransitionItem): Judged | undefined {
    return this.judged.get(key);
  }

  /** Judges these in place of others. */
  judge(transitions: Wanted[], reading: number): void {
    const asked = JSON.stringify([
      reading,
      transitions.map(({ item, values }) => [item.key, values]),
    ]);
    if (asked === this.asked) return;
    this.asked = asked;
    this.wanted = { transitions, reading };
    if (!this.isAsking) void this.ask();
  }

  private async ask(): Promise<void> {
    this.isAsking = true;
    for (let wanted = this.wanted; wanted; wanted = this.wanted) {
      this.wanted = null;
      await this.answer(wanted.transitions, wanted.reading);
      this.changed();
    }
    this.isAsking = false;
  }

  private async answer(transitions: Wanted[], reading: number): Promise<void> {
    const questions = transitions.map(({ item: { sheet, id }, values }) => ({
      chart: sheet,
      transition: id,
      values,
    }));
    // Of a text that is no more, or cannot be read, nothing is known.
    const answers = await this.document.judge(questions, reading).catch(() => []);
    this.judged.clear();
    for (const [at, { item, values }] of transitions.entries()) {
      const answer = answers[at];
      if (answer) this.judged.set(item.key, { ...answer, values });
    }
  }
}

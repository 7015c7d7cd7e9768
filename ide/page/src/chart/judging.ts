// Whether conditions of transitions are TRUE: has the module of charts judge them, one question after
// the other, always with the last values.
import type { ChartDocument } from "./document";
import type { TransitionItem } from "./drawn";
import { Overtaken } from "./charts";
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
    while (this.wanted) {
      const { transitions, reading } = this.wanted;
      this.wanted = null;
      const questions = transitions.map(({ item: { sheet, id }, values }) => ({
        chart: sheet,
        transition: id,
        values,
      }));
      const answers = await this.document.judge(questions, reading).catch((error: unknown) => {
        if (!(error instanceof Overtaken)) throw error;
        return [];
      });
      this.judged = new Map(
        answers.flatMap((answer, at) => {
          const { item, values } = transitions[at] ?? {};
          return item && values ? [[item.key, { ...answer, values }] as const] : [];
        }),
      );
      this.changed();
    }
    this.isAsking = false;
  }
}

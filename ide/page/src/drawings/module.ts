// The module of drawings as the rest of the page sees it: questions. Where it runs is known here
// alone.
import { Refusal } from "../core/core";
import { OpenQuestions } from "../core/questions";
import { addressOf } from "../offline/address";
import { notice } from "../page/notices";
import { DRAWING_WORDS } from "../text/drawing_words";
import { addWords, t } from "../text/language";

addWords(DRAWING_WORDS);

/** What can be asked: a wish and its answer for each question. */
type Asked<Q> = { [K in keyof Q]: { wish: object; answer: unknown } };
type Answer = { id: number } & ({ answer: unknown } | { refused: string });

/** A question whose answer nobody waits for any more. */
export class Overtaken extends Error {}

/** Tells why something could not be done; what is overtaken nobody waits for. */
export function tellRefusal(error: unknown): void {
  if (error instanceof Refusal) notice(error.message, true);
  else if (!(error instanceof Overtaken)) throw error;
}

export class DrawingsModule<Q extends Asked<Q>> {
  private worker: Worker | undefined;
  private questions = new OpenQuestions();

  /** Asks; the promise fails with a [`Refusal`], or as [`Overtaken`]. */
  ask<K extends keyof Q>(question: { do: K } & Q[K]["wish"]): Promise<Q[K]["answer"]> {
    this.worker ??= this.begin();
    const id = this.questions.newId();
    this.worker.postMessage(JSON.stringify({ id, ...question }));
    return this.questions.answerTo(id);
  }

  private begin(): Worker {
    const worker = new Worker(addressOf("drawings.js"), { type: "module" });
    worker.onerror = (event) => this.end(event.message || "drawings.js");
    worker.onmessage = ({ data }: MessageEvent<string | { broken: string }>) => {
      if (typeof data === "string") this.take(JSON.parse(data) as Answer);
      else this.end(data.broken);
    };
    return worker;
  }

  private take(answer: Answer): void {
    const question = this.questions.close(answer.id);
    if (!question) return;
    if ("refused" in answer) return question.reject(new Refusal(answer.refused));
    // What is done with a large answer is a task of its own after reading it.
    setTimeout(() => question.resolve(answer.answer));
  }

  /** The next question begins it anew. */
  private end(message: string): void {
    this.worker?.terminate();
    this.worker = undefined;
    this.questions.rejectAll(new Overtaken());
    notice(t("drawingBroken", message), true);
  }
}

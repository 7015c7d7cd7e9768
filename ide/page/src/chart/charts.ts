// The module of charts as the rest of the page sees it: questions. Where it runs is known here
// alone.
import { Refusal } from "../core/core";
import { OpenQuestions } from "../core/questions";
import { addressOf } from "../offline/address";
import type { Questions } from "./protocol";

type Kind = keyof Questions;
type Question<K extends Kind> = { do: K } & Questions[K]["wish"];
type Answer = { id: number } & ({ answer: unknown } | { refused: string });

/** A question whose answer nobody waits for any more. */
export class Overtaken extends Error {}

export class ChartsModule {
  private worker: Worker | undefined;
  private questions = new OpenQuestions();

  constructor(private broken: (message: string) => void) {}

  /** Asks; the promise fails with a [`Refusal`], or as [`Overtaken`]. */
  ask<K extends Kind>(question: Question<K>): Promise<Questions[K]["answer"]> {
    this.worker ??= this.begin();
    const id = this.questions.newId();
    this.worker.postMessage(JSON.stringify({ id, ...question }));
    return this.questions.answerTo(id);
  }

  private begin(): Worker {
    const worker = new Worker(addressOf("charts.js"), { type: "module" });
    worker.onerror = (event) => this.end(event.message || "charts.js");
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
    this.broken(message);
  }
}

// The module of charts as the rest of the page sees it: questions. Where it runs is known here
// alone.
import { Refusal } from "../core/core";
import { addressOf } from "../offline/address";
import type { Questions } from "./protocol";

type Kind = keyof Questions;
type Question<K extends Kind> = { do: K } & Questions[K]["wish"];
type Answer = { id: number } & ({ answer: unknown } | { refused: string });

interface Open {
  answered(answer: unknown): void;
  failed(error: Error): void;
}

/** A question whose answer nobody waits for any more. */
export class Overtaken extends Error {}

export class ChartsModule {
  private worker: Worker | undefined;
  private lastId = 0;
  private open = new Map<number, Open>();

  constructor(private broken: (message: string) => void) {}

  /** Asks; the promise fails with a [`Refusal`], or as [`Overtaken`]. */
  ask<K extends Kind>(question: Question<K>): Promise<Questions[K]["answer"]> {
    return new Promise((resolve, reject) => {
      this.worker ??= this.begin();
      const id = ++this.lastId;
      this.open.set(id, {
        answered: (answer) => resolve(answer as Questions[K]["answer"]),
        failed: reject,
      });
      this.worker.postMessage(JSON.stringify({ id, ...question }));
    });
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
    const open = this.open.get(answer.id);
    this.open.delete(answer.id);
    if (!open) return;
    if ("refused" in answer) return open.failed(new Refusal(answer.refused));
    // What is done with a large answer is a task of its own after reading it.
    setTimeout(() => open.answered(answer.answer));
  }

  /** The next question begins it anew. */
  private end(message: string): void {
    this.worker?.terminate();
    this.worker = undefined;
    const open = [...this.open.values()];
    this.open.clear();
    for (const one of open) one.failed(new Overtaken());
    this.broken(message);
  }
}

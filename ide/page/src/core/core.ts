// The core as the rest of the page sees it: orders, questions, events. Where it runs is known here
// alone.
import { keepEeprom, keptEeprom } from "../board/eeprom";
import { addressOf } from "../offline/address";
import { OpenQuestions } from "./questions";
import type { Event, EventKind, EventOf, Orders, Questions } from "./protocol";

type Listener = (event: never) => void;
/** What the worker tells. */
type Told = Event[] | { broken: string } | { eeprom: Uint8Array };
type Order = { [K in keyof Orders]: { do: K } & Orders[K] }[keyof Orders];
type Question<K extends keyof Questions> = { do: K } & Questions[K]["wish"];

/** The answer to a question that was refused. */
export class Refusal extends Error {}

/** How many orders can be refused late. */
const ORDERS_MAX = 256;

export class Core {
  /** Called before a question: what was written and not yet sent has to come first. */
  beforeQuestion: () => void = () => {};
  private worker = new Worker(addressOf("worker.js"), { type: "module" });
  private questions = new OpenQuestions();
  private orders = new Map<number, Order["do"]>();
  private listeners = new Map<EventKind, Listener[]>();
  private refusedListeners: ((what: Order["do"], message: string) => void)[] = [];

  constructor(broken: (message: string) => void) {
    this.worker.onerror = (event) => broken(event.message);
    this.worker.onmessage = ({ data }: MessageEvent<Told>) => {
      if (Array.isArray(data)) for (const event of data) this.take(event);
      else if ("broken" in data) broken(data.broken);
      else keepEeprom(data.eeprom);
    };
    const eeprom = keptEeprom();
    if (eeprom) this.worker.postMessage({ eeprom });
  }

  /** Has something done. */
  tell(order: Order): void {
    const id = this.send(order);
    this.orders.set(id, order.do);
    const oldest = this.orders.keys().next();
    if (this.orders.size > ORDERS_MAX && !oldest.done) this.orders.delete(oldest.value);
  }

  /** Asks; the promise fails with a [`Refusal`]. */
  ask<K extends keyof Questions>(question: Question<K>): Promise<Questions[K]["answer"]> {
    this.beforeQuestion();
    return this.questions.answerTo(this.send(question));
  }

  /** Listens to events of a kind, in the order in which listeners came. */
  on<K extends EventKind>(kind: K, listener: (event: EventOf<K>) => void): void {
    this.listeners.set(kind, [...(this.listeners.get(kind) ?? []), listener]);
  }

  /** Listens to orders that are refused. */
  onRefused(listener: (what: Order["do"], message: string) => void): void {
    this.refusedListeners.push(listener);
  }

  /** Bytes came from the target's line. */
  receive(bytes: Uint8Array): void {
    this.worker.postMessage(bytes);
  }

  private send(wish: object): number {
    const id = this.questions.newId();
    this.worker.postMessage(JSON.stringify({ id, ...wish }));
    return id;
  }

  private take(event: Event): void {
    if (event.is === "answer") this.questions.close(event.id)?.resolve(event.answer);
    if (event.is === "refused") this.refuse(event.id, event.message);
    for (const listener of this.listeners.get(event.is) ?? []) listener(event as never);
  }

  private refuse(id: number, message: string): void {
    const question = this.questions.close(id);
    const order = this.orders.get(id);
    if (question) question.reject(new Refusal(message));
    else if (order) for (const listener of this.refusedListeners) listener(order, message);
  }
}

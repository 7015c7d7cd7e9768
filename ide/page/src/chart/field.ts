// A field over the drawing in which a part of it is written. What is refused stays in it, with the
// reason; it offers names that begin as the word at the cursor does.
import { Refusal } from "../core/core";
import { h, newId } from "../page/dom";
import { t, type Args, type Key } from "../text/language";
import type { Canvas } from "./canvas";
import { Overtaken } from "../drawings/module";
import type { Frame } from "./protocol";

const OFFERED_MAX = 8;
const WIDTH_MIN = 150;

export interface Wish {
  /** What is written. */
  label: [Key, ...Args];
  value: string;
  /** Over which part of the drawing. */
  at: Frame;
  /** What it offers. */
  names: Promise<string[]>;
  /** Takes what was written; fails with a [`Refusal`]. */
  take(text: string): Promise<void>;
  /** The focus goes back, with the keys that were pressed while it took what was written; not where
   * it was left for another place. */
  done(early: KeyboardEvent[], isLeft: boolean): void;
}

export class Field {
  private wish: Wish | undefined;
  private names: string[] = [];
  private chosen = -1;
  private isTaking = false;
  private isOffering = false;
  private early: KeyboardEvent[] = [];
  private list = h("ul", { class: "offered", attributes: { role: "listbox", id: newId() } });
  private refusal = h("p", { class: "refusal", attributes: { role: "alert", id: newId() } });
  private input = h("textarea", {
    attributes: {
      spellcheck: "false",
      autocomplete: "off",
      "aria-autocomplete": "list",
      "aria-controls": this.list.id,
      "aria-describedby": this.refusal.id,
    },
    on: {
      input: () => this.written(),
      keydown: (event) => this.keys(event),
      blur: () => void this.take(true),
    },
  });
  private element = h(
    "div",
    { class: "field", set: { hidden: true } },
    this.input,
    this.refusal,
    this.list,
  );

  constructor(private canvas: Canvas) {
    canvas.ground.append(this.element);
    canvas.onView(() => this.place());
  }

  get isOpen(): boolean {
    return this.wish !== undefined;
  }

  /** Opens it; `written` was written while it was not there yet, perhaps to its end. */
  open(wish: Wish, written = ""): void {
    this.wish = wish;
    this.names = [];
    void wish.names.then((names) => {
      if (this.wish !== wish) return;
      this.names = names;
      // They may come after what they are offered for was written.
      if (this.isOffering) this.offer(true);
    });
    this.input.setAttribute("aria-label", t(...wish.label));
    this.input.value = written.trimEnd() || wish.value;
    this.element.hidden = false;
    this.say("");
    this.grow();
    this.place();
    this.input.focus({ preventScroll: true });
    if (!written) this.input.select();
    this.canvas.reveal(wish.at);
    if (written.endsWith("\n")) void this.take(false);
  }

  private place(): void {
    if (!this.wish) return;
    const [x, y, width] = this.wish.at;
    const { bounds, zoom, element } = this.canvas;
    const wide = Math.min(Math.max(width * zoom, WIDTH_MIN), element.clientWidth - 8);
    const left = (x - bounds[0]) * zoom;
    const right = element.scrollLeft + element.clientWidth - wide - 4;
    this.element.style.left = `${Math.max(0, Math.min(left, right))}px`;
    this.element.style.top = `${(y - bounds[1]) * zoom}px`;
    this.element.style.width = `${wide}px`;
  }

  /** Closes it; `isLeft`: what a person does next is elsewhere. */
  private close(isLeft = false): void {
    const { wish } = this;
    this.wish = undefined;
    this.element.hidden = true;
    wish?.done(this.early.splice(0), isLeft);
  }

  private written(): void {
    this.say("");
    this.grow();
    this.offer(this.word() !== "");
  }

  private grow(): void {
    this.input.rows = this.input.value.split("\n").length;
  }

  private say(refusal: string): void {
    this.refusal.textContent = refusal;
    this.refusal.hidden = refusal === "";
    this.input.setAttribute("aria-invalid", String(refusal !== ""));
    this.offer(false);
  }

  /** Takes what was written. Who leaves the field without having written leaves it as it was. */
  private async take(isLeft: boolean): Promise<void> {
    const { wish, input } = this;
    if (!wish || this.isTaking) return;
    if (isLeft && input.value === wish.value) return this.close(isLeft);
    this.isTaking = true;
    try {
      if (input.value !== wish.value) await wish.take(input.value.trim());
      this.close(isLeft);
    } catch (error) {
      if (!(error instanceof Refusal || error instanceof Overtaken)) throw error;
      this.say(error.message);
      this.early = [];
      if (!isLeft) input.focus();
    } finally {
      this.isTaking = false;
    }
  }

  private keys(event: KeyboardEvent): void {
    event.stopPropagation();
    if (this.isTaking) {
      this.early.push(event);
      return event.preventDefault();
    }
    const { length } = this.list.children;
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step && length > 0) this.choose((this.chosen + step + length) % length);
    else if (event.key === "ArrowDown" || (event.key === " " && event.ctrlKey)) this.offer(true);
    else if (event.key === "Tab" && length > 0) this.put(Math.max(this.chosen, 0));
    else if (event.key === "Enter" && this.chosen >= 0) this.put(this.chosen);
    else if (event.key === "Enter" && !event.shiftKey) void this.take(false);
    else if (event.key === "Escape" && length > 0) this.offer(false);
    else if (event.key === "Escape") this.close();
    else return;
    event.preventDefault();
  }

  /** The word before the cursor. */
  private word(): string {
    const { value, selectionStart } = this.input;
    return /[\w.%]*$/.exec(value.slice(0, selectionStart))?.[0] ?? "";
  }

  private offer(isOffered: boolean): void {
    this.isOffering = isOffered;
    const word = this.word().toLowerCase();
    const fits = (name: string) =>
      name.toLowerCase().startsWith(word) && name.toLowerCase() !== word;
    const names = isOffered ? this.names.filter(fits).slice(0, OFFERED_MAX) : [];
    this.list.replaceChildren(...names.map((name, at) => this.option(name, at)));
    this.list.hidden = names.length === 0;
    this.choose(-1);
  }

  private option(name: string, at: number): HTMLElement {
    const attributes = { role: "option", id: newId(), "aria-selected": "false" };
    const take = (event: Event) => {
      // The field keeps the focus.
      event.preventDefault();
      this.put(at);
    };
    return h("li", { attributes, on: { pointerdown: take, mousedown: take } }, name);
  }

  private choose(at: number): void {
    this.chosen = at;
    this.input.removeAttribute("aria-activedescendant");
    for (const [index, option] of [...this.list.children].entries()) {
      option.setAttribute("aria-selected", String(index === at));
      if (index === at) this.input.setAttribute("aria-activedescendant", option.id);
    }
  }

  /** Puts an offered name in the place of the word at the cursor. */
  private put(at: number): void {
    const name = this.list.children[at]?.textContent;
    if (!name) return;
    const end = this.input.selectionStart;
    this.input.setRangeText(name, end - this.word().length, end, "end");
    this.grow();
    this.offer(false);
  }
}

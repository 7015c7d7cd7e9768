// A choice of up to eight signals.
import { h, iconButton } from "../page/dom";
import { icon } from "../page/icons";
import type { Operands } from "./operands";
import type { Chosen, What } from "../project/chosen";

const SIGNALS_MAX = 8;

export class Signals {
  readonly element: HTMLElement;
  names: string[] = [];
  private chips = h("ul", { class: "chips" });
  private field: HTMLInputElement;

  constructor(
    operands: Operands,
    private chosen: Chosen,
    /** For what they are chosen. */
    private what: What,
    private changed: () => void,
  ) {
    this.field = operands.field("addSignal");
    const submit = (event: Event) => {
      event.preventDefault();
      this.add(this.field.value.split(/[\s,;]+/).filter(Boolean));
      this.field.value = "";
    };
    this.element = h(
      "div",
      { class: "signals" },
      this.chips,
      h(
        "form",
        { class: "line-form", on: { submit } },
        this.field,
        h("button", { text: "addIt", attributes: { type: "submit" } }),
      ),
    );
    chosen.onOpened(() => {
      this.names = chosen.text(what).split(",").filter(Boolean);
      this.draw();
      this.changed();
    });
    this.draw();
  }

  /** Chooses these too; where there are too many the first ones go. */
  add(names: string[]): void {
    this.set([...this.names, ...names]);
  }

  private set(names: string[]): void {
    this.names = [...new Set(names)].slice(-SIGNALS_MAX);
    this.chosen.keep(this.what, this.names.join(","));
    this.draw();
    this.changed();
  }

  private draw(): void {
    this.chips.hidden = this.names.length === 0;
    this.field.disabled = this.names.length >= SIGNALS_MAX;
    this.chips.replaceChildren(
      ...this.names.map((name) => {
        const remove = () => {
          this.set(this.names.filter((other) => other !== name));
          this.field.focus();
        };
        return h("li", {}, name, iconButton(icon("close"), "removeSignal", remove, name));
      }),
    );
  }
}

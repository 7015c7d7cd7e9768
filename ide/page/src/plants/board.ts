// The Uno as a board: a lamp at each output pin, and for its inputs switches, push buttons and
// sliders.
import type { Core } from "../core/core";
import type { Pins } from "../core/protocol";
import { h, s, say } from "../page/dom";
import { hold } from "./hold";
import { sheet } from "./picture";

const POINTS = 6;
const COUNTS_MAX = 1023;
/** Places on the drawing. */
const PIN_STEP = 40;
const OUTPUT_LEFT = 120;
const INPUT_LEFT = 364;

interface Input {
  element: HTMLElement;
  toggle: HTMLButtonElement;
  push: HTMLButtonElement;
}

export class Board {
  readonly element: HTMLElement;
  private outputs: SVGElement[] = [];
  private inputLamps: SVGElement[] = [];
  private inputs: Input[] = [];
  private sliders: HTMLInputElement[] = [];
  private shownCounts: HTMLElement[] = [];
  /** Inputs that are switched on here, apart from those that are pressed. */
  private switched = 0;

  constructor(private core: Core) {
    const numbers = Array.from({ length: POINTS }, (_, number) => number);
    this.inputs = numbers.map((number) => this.input(number));
    const analog = numbers.map((number) => this.slider(number));
    this.element = h(
      "div",
      { class: "board" },
      this.drawing(numbers),
      h("h2", { text: "inputs" }),
      h("div", { class: "inputs" }, ...this.inputs.map((input) => input.element)),
      h("h2", { text: "analogInputs" }),
      h("div", { class: "sliders" }, ...analog),
    );
  }

  private drawing(numbers: number[]): SVGElement {
    const pins = (left: number, first: number, name: string, lamps: SVGElement[], kind: string) =>
      numbers.flatMap((number) => {
        // On the board the pin with the greatest number is the leftmost.
        const x = left + (POINTS - 1 - number) * PIN_STEP;
        const lamp = s("circle", { cx: x, cy: 74, r: 9, class: `led ${kind}` });
        lamps[number] = lamp;
        return [
          s("rect", { x: x - 9, y: 14, width: 18, height: 18, class: "socket" }),
          s("text", { x, y: 48, "text-anchor": "middle", class: "pin" }, `D${first + number}`),
          lamp,
          s("text", { x, y: 102, "text-anchor": "middle", class: "pin" }, `${name}.${number}`),
        ];
      });
    const analog = numbers.flatMap((number) => {
      const x = INPUT_LEFT + number * PIN_STEP;
      return [
        s("rect", { x: x - 9, y: 196, width: 18, height: 18, class: "socket" }),
        s("text", { x, y: 188, "text-anchor": "middle", class: "pin" }, `A${number}`),
      ];
    });
    return sheet(
      640,
      230,
      "plantBoard",
      s("path", { d: "M40 6H592l14 14v54l14 12v92l-14 14v32H40z", class: "print" }),
      s("rect", { x: 10, y: 30, width: 84, height: 66, class: "metal" }),
      s("rect", { x: 24, y: 158, width: 76, height: 56, class: "socket" }),
      s("rect", { x: 200, y: 132, width: 150, height: 34, rx: 3, class: "socket" }),
      s("text", { x: 275, y: 154, "text-anchor": "middle", class: "pin" }, "ATmega328P"),
      ...pins(OUTPUT_LEFT, 8, "Q0", this.outputs, "output"),
      ...pins(INPUT_LEFT, 2, "I0", this.inputLamps, "input"),
      ...analog,
    );
  }

  private input(number: number): Input {
    const name = `I0.${number}`;
    const toggle = h("button", {
      class: "switch",
      attributes: { type: "button", role: "switch", "aria-checked": "false" },
      on: { click: () => this.toggle(number) },
    });
    say(toggle, "aria-label", "switchInput", name);
    const push = h("button", { class: "push", attributes: { type: "button" } });
    say(push, "aria-label", "pushInput", name);
    say(push, "title", "pushInput", name);
    hold(push, () => this.drive(number));
    const element = h("div", { class: "input" }, h("span", { class: "pin" }, name), toggle, push);
    return { element, toggle, push };
  }

  private toggle(number: number): void {
    this.switched ^= 1 << number;
    this.inputs[number]?.toggle.setAttribute("aria-checked", String(this.isSwitched(number)));
    this.drive(number);
  }

  private isSwitched(number: number): boolean {
    return ((this.switched >> number) & 1) === 1;
  }

  /** A push button turns over what the switch says. */
  private drive(number: number): void {
    const isDown = this.inputs[number]?.push.classList.contains("down") ?? false;
    const value = this.isSwitched(number) !== isDown ? 1 : 0;
    this.core.tell({ do: "drive", operand: `I0.${number}`, value });
  }

  private slider(number: number): HTMLElement {
    const name = `Ain${number}`;
    const slider = h("input", {
      attributes: { type: "range", min: 0, max: COUNTS_MAX, "aria-label": name },
      set: { value: "0" },
    });
    const shown = h("output", {}, "0");
    slider.addEventListener("input", () => {
      shown.textContent = slider.value;
      this.core.tell({ do: "drive", operand: name, value: Number(slider.value) });
    });
    this.sliders.push(slider);
    this.shownCounts.push(shown);
    return h("div", { class: "slider" }, h("span", { class: "pin" }, name), slider, shown);
  }

  /** What a plant drives cannot be moved by hand. */
  setDriven({ digital, analog }: { digital: number; analog: number }): void {
    for (const [number, { toggle, push }] of this.inputs.entries())
      toggle.disabled = push.disabled = ((digital >> number) & 1) === 1;
    for (const [number, slider] of this.sliders.entries())
      slider.disabled = ((analog >> number) & 1) === 1;
  }

  show({ inputs, outputs, analog }: Pins): void {
    for (let number = 0; number < POINTS; number += 1) {
      const bit = (bits: number) => ((bits >> number) & 1) === 1;
      this.outputs[number]?.classList.toggle("on", bit(outputs));
      this.inputLamps[number]?.classList.toggle("on", bit(inputs));
      const slider = this.sliders[number];
      const counts = analog[number];
      if (!slider || counts === undefined || slider === document.activeElement) continue;
      slider.value = String(counts);
      const shown = this.shownCounts[number];
      if (shown) shown.textContent = String(counts);
    }
  }
}

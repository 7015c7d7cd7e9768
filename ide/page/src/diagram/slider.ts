// A slider that sets a REAL of the target while it is moved.
import { h, say } from "../page/dom";

/** From one value to the next one while it is moved. */
const WRITE_MS = 100;
const STEPS = 200;

export class Slider {
  readonly element = h("input", { attributes: { type: "range" } });
  private timer = 0;

  /** Around a value that is declared. */
  constructor(
    name: string,
    declared: number,
    private set: (value: string) => void,
  ) {
    say(this.element, "aria-label", "diagramSlider", name);
    this.reach(declared);
    this.element.value = String(declared);
    this.element.addEventListener("input", () => {
      this.timer ||= window.setTimeout(() => {
        this.timer = 0;
        this.set(real(this.element.value));
      }, WRITE_MS);
    });
  }

  /** What the target has; nothing can be set where that is not known. */
  show(value: number | null): void {
    this.element.disabled = value === null;
    if (value === null || document.activeElement === this.element) return;
    const { min, max } = this.element;
    if (value < Number(min) || value > Number(max)) this.reach(value);
    this.element.value = String(value);
  }

  /** It goes up to twice of a value, and below zero where that is not positive. */
  private reach(value: number): void {
    const most = value === 0 ? 1 : Math.abs(value) * 2;
    const least = value > 0 ? 0 : -most;
    const range = { min: least, max: most, step: (most - least) / STEPS };
    for (const [name, at] of Object.entries(range)) this.element.setAttribute(name, String(at));
  }
}

/** A number as a REAL is written. */
export function real(text: string): string {
  return text.includes(".") || text.includes("e") ? text : `${text}.0`;
}

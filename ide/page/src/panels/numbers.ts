// Numbers in panels: fields for them, and figures with as many digits as people read.
import { h } from "../page/dom";

/** A field that must have a number. */
export function numberField(
  value: number,
  limits: { min?: number; max?: number; step?: number | "any" },
): HTMLInputElement {
  return h("input", {
    attributes: { type: "number", required: true, ...limits },
    set: { value: String(value) },
  });
}

/** Four digits, and no more than so many decimals. */
export function rounded(value: number, decimals = 4): number {
  return Number(Number(value.toFixed(decimals)).toPrecision(4));
}

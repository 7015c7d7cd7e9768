// How a value is shown: as the core has it, or in another form.
import type { Value } from "../core/protocol";

export const FORMATS = ["auto", "signed", "unsigned", "hex", "binary", "real"] as const;
export type Format = (typeof FORMATS)[number];

/** Bits of a form. */
const BITS: Record<string, number> = { bit: 1, byte: 8, word: 16, double: 32, real: 32 };

/** The pattern of a value, as a number without sign. */
function pattern(number: number, form: string): number {
  const view = new DataView(new ArrayBuffer(4));
  if (form === "real") view.setFloat32(0, number);
  else view.setInt32(0, number);
  const all = view.getUint32(0);
  const bits = BITS[form] ?? 32;
  return bits === 32 ? all : all & (2 ** bits - 1);
}

/** The words for a value. */
export function formatted(value: Value, format: Format): string {
  const { number, form, text } = value;
  if (number === null || format === "auto") return text;
  const bits = BITS[form] ?? 32;
  const raw = pattern(number, form);
  switch (format) {
    case "signed":
      return String(bits === 1 ? raw : (raw << (32 - bits)) >> (32 - bits));
    case "unsigned":
      return String(raw);
    case "hex":
      return `16#${raw
        .toString(16)
        .toUpperCase()
        .padStart(Math.ceil(bits / 4), "0")}`;
    case "binary":
      return `2#${raw
        .toString(2)
        .padStart(bits, "0")
        .replace(/\B(?=(\d{4})+$)/g, "_")}`;
    case "real":
      return bits === 32 ? real(raw) : text;
  }
}

function real(raw: number): string {
  const view = new DataView(new ArrayBuffer(4));
  view.setUint32(0, raw);
  return String(Number(view.getFloat32(0).toPrecision(7)));
}

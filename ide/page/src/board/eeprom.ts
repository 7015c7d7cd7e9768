// The EEPROM of the virtual Uno as the browser keeps it: there is one such board in a browser, as
// there is one on a desk.
import { store, storedText } from "../project/stored";

const KEY = "uno200.eeprom";

/** What was kept; null of a new board. */
export function keptEeprom(): Uint8Array | null {
  const digits = storedText(KEY);
  if (digits === null || !/^([0-9a-f]{2})+$/.test(digits)) return null;
  return Uint8Array.from(digits.match(/../g) ?? [], (pair) => parseInt(pair, 16));
}

/** Keeps it; the board goes on without, where there is no room. */
export function keepEeprom(bytes: Uint8Array): void {
  const digits = Array.from(bytes, (byte) => byte.toString(16).padStart(2, "0"));
  store(KEY, digits.join(""));
}

// What wasm-bindgen makes of ide/core.

/** Loads the module from its address. */
export default function init(from: { module_or_path: URL }): Promise<unknown>;

/** The core. Answers are JSON arrays of events. */
export class Ide {
  constructor();
  request(json: string, nowMs: number): string;
  tick(nowMs: number, scansMax: number): string;
  isBehind(): boolean;
  receive(bytes: Uint8Array, nowMs: number): string;
  chipDueMs(): number;
  chipPassed(data: Uint8Array): Uint16Array;
  chipPins(): Uint16Array;
  chipBytes(): Uint8Array;
}

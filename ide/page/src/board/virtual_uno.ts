// The virtual Uno at the core's line: the chip, with the bytes that the core sends and what the core
// says is at its pins. Time is the core's business: it says how much is due.
import type { Event } from "../core/protocol";
import { CYCLES_PER_MS, Chip, POINTS } from "./chip";

/** The core's side of it. */
export interface Surroundings {
  /** Milliseconds of the chip that are due. */
  chipDueMs(): number;
  /** A millisecond has passed; gives the levels of D2 to D7, and the counts of A0 to A5. */
  chipPassed(data: Uint8Array): Uint16Array;
  /** What is at the pins before the first one. */
  chipPins(): Uint16Array;
  /** Bytes that are due on its line now. */
  chipBytes(): Uint8Array;
}

export class VirtualUno {
  /** Without a program; plugged in or not, its EEPROM stays. */
  private chip = new Chip();
  /** Whether it is plugged in. */
  isOn = false;

  /** The EEPROM as it was told last. */
  private told = Uint8Array.from(this.chip.eepromBytes);

  /** The EEPROM of an earlier time; the board has to be off. */
  setEeprom(bytes: Uint8Array): void {
    this.chip.eepromBytes.set(bytes.subarray(0, this.chip.eepromBytes.length));
    this.told = Uint8Array.from(this.chip.eepromBytes);
  }

  /** The EEPROM, if it is another one than the last time. */
  newEeprom(): Uint8Array | null {
    const now = this.chip.eepromBytes;
    if (now.every((byte, index) => byte === this.told[index])) return null;
    this.told = Uint8Array.from(now);
    return this.told;
  }

  /** Takes what is for the chip; whether it was. */
  take(event: Event, core: Surroundings): boolean {
    switch (event.is) {
      case "powerOn":
        this.isOn = true;
        this.chip.powerOn(Uint8Array.from(event.flash));
        this.drive(core.chipPins());
        return true;
      case "powerOff":
        this.isOn = false;
        return true;
      case "resetBoard":
        if (this.isOn) this.chip.reset();
        return this.isOn;
      case "send":
        if (this.isOn) this.chip.receive(event.bytes);
        return this.isOn;
      default:
        return false;
    }
  }

  /** Lets the time pass that is due, as far as there is time for it until `end`; bytes that the
   *  chip sends are answered at once, in the millisecond in which they came. */
  goOn(core: Surroundings, end: number, sent: (bytes: Uint8Array) => void): void {
    for (let due = core.chipDueMs(); this.isOn && due > 0; due--) {
      this.chip.run(CYCLES_PER_MS);
      this.drive(core.chipPassed(this.chip.data));
      const bytes = this.chip.takeSent();
      if (bytes.length > 0) sent(bytes);
      this.chip.receive(core.chipBytes());
      if (performance.now() >= end) return;
    }
  }

  private drive(pins: Uint16Array): void {
    const [levels = 0, ...counts] = pins;
    for (let input = 0; input < POINTS; input++)
      this.chip.drive(input, ((levels >> input) & 1) !== 0);
    for (const [channel, count] of counts.entries()) this.chip.setCounts(channel, count);
  }
}

// A chip of the page as the core drives it, for a lock-step: what lock_step.mjs loads into a page.
import { Chip } from "../src/board/chip.ts";

export class Driven {
  chip = new Chip();
  mark = 0;

  constructor() {
    this.chip.onMark = (mark) => {
      this.mark = mark;
      this.chip.hold();
    };
  }

  powerOn(flash) {
    this.chip.powerOn(flash);
  }

  run(cycles) {
    this.mark = 0;
    this.chip.run(cycles);
    return this.mark;
  }

  data() {
    return this.chip.data;
  }

  write(address, byte) {
    this.chip.data[address] = byte;
  }

  drive(levels, counts) {
    for (let input = 0; input < 6; input++) this.chip.drive(input, ((levels >> input) & 1) !== 0);
    for (const [channel, count] of counts.entries()) this.chip.setCounts(channel, count);
  }
}

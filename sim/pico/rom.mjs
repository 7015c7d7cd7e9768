// What the firmware calls in the chip's ROM: the functions that erase and write flash. Each is a
// breakpoint, at which this module does what the function does, and a return. The real ROM is not
// needed: it does nothing else here. While they work the power can be cut.

const TABLE_AT = 0x14;
const LOOKUP_AT = 0x18;
const TABLE = 0x100;
const FIRST_FUNCTION = 0x200;
const FUNCTION_LEN = 4;
const BKPT = 0xbe00;
const BX_LR = 0x4770;
const THUMB = 1;
const FLASH_MASK = 0xffffff;
const SRAM = 0x20000000;

/** The bits of a byte that have their new value when the power is cut in the middle of it. */
const HALF = 0xa5;

/** The power of a board: for how many bytes of flash that are erased or written there is some. */
export class Power {
  constructor() {
    this.bytes = Infinity;
  }

  /** Changes bytes of flash, each as `changed` makes it, until there is no power. */
  change(flash, from, count, changed) {
    for (let n = 0; n < count; n++) {
      const [old, wanted] = [flash[from + n], changed(flash[from + n], n)];
      if (this.bytes === 0) {
        flash[from + n] = (old & ~HALF) | (wanted & HALF);
        throw new Cut();
      }
      this.bytes -= 1;
      flash[from + n] = wanted;
    }
  }
}

/** The power was cut. */
export class Cut extends Error {}

/** What a function does; registers are its parameters. */
const functions = {
  // Looks a function up: table, code.
  "": ({ registers }, { address }) => {
    registers[0] = address(String.fromCharCode(registers[1] & 0xff, registers[1] >>> 8));
  },
  // connect_internal_flash, flash_exit_xip, flash_flush_cache, flash_enter_cmd_xip.
  IF() {},
  EX() {},
  FC() {},
  CX() {},
  // flash_range_erase: offset, count, block size, command.
  RE({ registers }, { flash, power }) {
    const [offset, count] = registers;
    power.change(flash, offset & FLASH_MASK, count, () => 0xff);
  },
  // flash_range_program: offset, data, count.
  RP({ registers }, { flash, sram, power }) {
    const [offset, from, count] = registers;
    const at = from - SRAM;
    // Bits are only cleared.
    power.change(flash, offset & FLASH_MASK, count, (old, n) => old & sram[at + n]);
  },
};

const names = Object.keys(functions);

function address(name) {
  const number = names.indexOf(name);
  return number < 0 ? 0 : (FIRST_FUNCTION + number * FUNCTION_LEN) | THUMB;
}

/** Gives a chip the ROM. Returns the power of its flash. */
export function romOf(chip) {
  const power = new Power();
  const rom = new DataView(chip.bootrom.buffer);
  rom.setUint16(TABLE_AT, TABLE, true);
  rom.setUint16(LOOKUP_AT, address(""), true);
  names.forEach((name, number) => {
    const at = FIRST_FUNCTION + number * FUNCTION_LEN;
    rom.setUint16(at, BKPT | number, true);
    rom.setUint16(at + 2, BX_LR, true);
  });
  const { flash, sram, core } = chip;
  chip.onBreak = (number) => functions[names[number]]?.(core, { flash, sram, address, power });
  return power;
}

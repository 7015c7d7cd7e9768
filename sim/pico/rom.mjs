// What the firmware calls in the chip's ROM: the functions that erase and write flash. Each is a
// breakpoint, at which this module does what the function does, and a return. The real ROM is not
// needed: it does nothing else here.

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
  RE({ registers }, { flash }) {
    const [offset, count] = registers;
    flash.fill(0xff, offset & FLASH_MASK, (offset & FLASH_MASK) + count);
  },
  // flash_range_program: offset, data, count.
  RP({ registers }, { flash, sram }) {
    const [offset, from, count] = registers;
    const at = from - SRAM;
    // Bits are only cleared.
    for (let n = 0; n < count; n++) flash[(offset & FLASH_MASK) + n] &= sram[at + n];
  },
};

const names = Object.keys(functions);

function address(name) {
  const number = names.indexOf(name);
  return number < 0 ? 0 : (FIRST_FUNCTION + number * FUNCTION_LEN) | THUMB;
}

/** Gives a chip the ROM. */
export function romOf(chip) {
  const rom = new DataView(chip.bootrom.buffer);
  rom.setUint16(TABLE_AT, TABLE, true);
  rom.setUint16(LOOKUP_AT, address(""), true);
  names.forEach((name, number) => {
    const at = FIRST_FUNCTION + number * FUNCTION_LEN;
    rom.setUint16(at, BKPT | number, true);
    rom.setUint16(at + 2, BX_LR, true);
  });
  const { flash, sram, core } = chip;
  chip.onBreak = (number) => functions[names[number]]?.(core, { flash, sram, address });
}

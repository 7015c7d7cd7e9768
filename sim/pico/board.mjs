// A Raspberry Pi Pico: the PLC's firmware in the emulator rp2040js, scan by scan with a clock that is
// held, or free. What programs, operands and scenarios are is not known here, nor who asks.

import { readFileSync, statSync } from "node:fs";
import { executed } from "./cycles.mjs";
import { romOf } from "./rom.mjs";

const FLASH = 0x10000000;
const SRAM = 0x20000000;
const VECTORS = 0x100;
const PROGRAM = 0x100000;
const FLASH_LEN = 0x200000;
const NANOS_OF_CYCLE = 8;
export const CYCLES_OF_US = 125;
// Of a UF2 file.
const BLOCK = 512;

// Registers of peripherals, as rp2040js asks for them.
const WATCHDOG = 0x40058;
const WATCHDOG_LOAD = 0x04;
const WATCHDOG_LOAD_MAX = 0xffffff;
const TIMER = 0x40054;
const TIMERAWL = 0x28;
const MARK = 0x14;
const DATA_ADDRESS = 0x18;
export const SCAN_START = 1;
const SCAN_END = 2;

const FIRST_INPUT = 2;
export const FIRST_OUTPUT = 10;
export const POINTS = 8;
const PWM = 4;
const PWM_CC = 0x4005000c;
const PWM_SLICE_LEN = 0x14;
const NO_DUTY = 0xffff;

// Cycles from power to the first scan, and from a scan to the next.
const BOOT_MAX = 100_000_000;
const PAUSE_MAX = 2_000_000;
// From when on each look at the clock takes a millisecond, until the scan has ended.
const LATE_MAX = 400_000_000;
const LOOK_US = 1000;
// Cycles until inputs have been read, and until the interrupt has taken what is in the FIFO.
const INPUTS_MAX = 200_000;
const CHARACTERS_MAX = 100_000;
const FIFO_LEN = 32;

// Where the analog inputs are in data memory, and their bytes.
const ANALOG_AT = 0x100;
export const ANALOG_LEN = 24;
// Of all analog bytes the firmware writes those of AIW10 last; no reading makes these of them.
const LAST_ANALOG = [ANALOG_AT + 10, ANALOG_AT + 11];
const NO_READING = 0xff;

const quiet = { debug() {}, info() {}, warn() {}, error() {} };

// Of the packages.
let RP2040, USBCDC, decodeBlock, isUF2Block;

/** Loads the emulator. Before all else. */
export async function load() {
  ({ RP2040, USBCDC } = await import("rp2040js"));
  ({ decodeBlock, isUF2Block } = await import("uf2"));
}

/** What a firmware, as ELF or as UF2, has to be in flash before the program. */
function segments(file) {
  const parts = file.length > 0 && file.length % BLOCK === 0 && isUF2Block(block(file, 0))
    ? ofUf2(file)
    : ofElf(file);
  const isInFlash = ({ address, bytes }) =>
    bytes.length > 0 && address >= FLASH && address + bytes.length <= FLASH + PROGRAM;
  return parts
    .filter(isInFlash)
    .map(({ address, bytes }) => ({ at: address - FLASH, bytes }));
}

/** A block of a UF2 file, in a buffer of its own. */
function block(file, at) {
  return new Uint8Array(file.subarray(at, at + BLOCK));
}

function ofUf2(file) {
  const starts = Array.from({ length: file.length / BLOCK }, (_, number) => number * BLOCK);
  return starts.map((at) => {
    const { flashAddress, payload } = decodeBlock(block(file, at));
    return { address: flashAddress, bytes: payload };
  });
}

function ofElf(elf) {
  if (elf.length < 52 || elf.readUInt32BE(0) !== 0x7f454c46 || elf[4] !== 1) {
    throw new Error("the firmware is neither an ELF of 32 bits nor UF2");
  }
  const [start, len, count] = [elf.readUInt32LE(28), elf.readUInt16LE(42), elf.readUInt16LE(44)];
  const headers = Array.from({ length: count }, (_, number) => start + number * len);
  return headers
    .filter((at) => elf.readUInt32LE(at) === 1)
    .map((at) => {
      const [offset, size] = [elf.readUInt32LE(at + 4), elf.readUInt32LE(at + 16)];
      return { address: elf.readUInt32LE(at + 12), bytes: elf.subarray(offset, offset + size) };
    });
}

/** The firmware in a file; and, once it was there, what its start-up makes of memory. */
class Firmware {
  constructor(path) {
    this.segments = segments(readFileSync(path));
    this.start = null;
  }

  load(flash) {
    for (const { at, bytes } of this.segments) flash.set(bytes, at);
  }
}

const known = new Map();

/** The firmware in a file, which is read once. */
export function firmwareAt(path) {
  const { mtimeMs, size } = statSync(path);
  const key = `${path} ${mtimeMs} ${size}`;
  if (!known.has(key)) known.set(key, new Firmware(path));
  return known.get(key);
}

/** A board. It stands still between calls. */
export class Board {
  constructor(firmware, image, dataLen) {
    this.firmware = firmware;
    this.dataLen = dataLen;
    this.chip = new RP2040();
    this.chip.logger = quiet;
    firmware.load(this.chip.flash);
    this.chip.flash.set(image, PROGRAM);
    this.power = romOf(this.chip);
    [this.cycles, this.mark, this.dataAt] = [0, 0, 0];
    [this.nowUs, this.lookUs] = [0, 0];
    [this.isHung, this.isHeld] = [false, false];
    [this.sent, this.sentByUsb, this.toSend] = [[], [], []];
    [this.isOpen, this.place] = [false, null];
    this.atStart = false;
    this.listen();
  }

  /** Has what the firmware does at some registers told, and holds its clock. */
  listen() {
    const watchdog = this.chip.peripherals[WATCHDOG];
    const write = watchdog.writeUint32.bind(watchdog);
    watchdog.writeUint32 = (offset, value) => {
      if (offset === MARK) this.mark = value;
      if (offset === DATA_ADDRESS) this.dataAt = value;
      write(offset, value);
    };
    watchdog.onWatchdogTrigger = () => {
      // While the clock stands still nobody feeds it, and its alarm comes again and again.
      if (this.isHeld) write(WATCHDOG_LOAD, WATCHDOG_LOAD_MAX);
      this.isHung = !this.isHeld;
    };
    this.scratch = watchdog.scratchData;
    const timer = this.chip.peripherals[TIMER];
    const read = timer.readUint32.bind(timer);
    timer.readUint32 = (offset) => (offset === TIMERAWL ? this.look() : read(offset));
    this.chip.uart[0].onByte = (character) => this.sent.push(character);
  }

  /** The board after a power cut, with what is in its flash then. It is off. */
  again() {
    const board = new Board(this.firmware, Buffer.alloc(0), this.dataLen);
    board.chip.flash.set(this.chip.flash.subarray(0, FLASH_LEN));
    return board;
  }

  /** Plugs a computer in, which opens the serial port; before power comes. */
  plugIn() {
    const usb = this.chip.usbCtrl;
    const port = new USBCDC(usb);
    port.onSerialData = (bytes) => this.sentByUsb.push(...bytes);
    port.onDeviceConnected = () => {
      this.isOpen = true;
    };
    // The package's own way forgets a place for a packet that there was before it knew the port.
    usb.onEndpointRead = (endpoint, room) => {
      if (endpoint !== 0) this.place = { endpoint, room };
      this.sendByUsb([]);
    };
  }

  /** Sends characters to the board by USB, a packet where there is a place for one. */
  sendByUsb(characters) {
    this.toSend.push(...characters);
    if (!this.isOpen || this.place === null || this.toSend.length === 0) return;
    const { endpoint, room } = this.place;
    this.place = null;
    this.chip.usbCtrl.endpointReadDone(endpoint, Uint8Array.from(this.toSend.splice(0, room)));
  }

  look() {
    this.nowUs = (this.nowUs + this.lookUs) >>> 0;
    return this.nowUs;
  }

  /** From now on the clock goes on with the cycles. */
  freeClock() {
    const begin = this.cycles - this.nowUs * CYCLES_OF_US;
    this.look = () => Math.floor((this.cycles - begin) / CYCLES_OF_US) >>> 0;
  }

  /** Executes until this is so, at most for so many cycles. Whether it came to be so. */
  runUntil(isSo, cyclesMax) {
    const { core, clock } = this.chip;
    const end = this.cycles + cyclesMax;
    while (!isSo()) {
      if (this.cycles >= end) return false;
      if (this.isHung) throw new Error("the firmware has not fed the hardware watchdog: it hangs");
      if (core.waiting) clock.tick(clock.nanosToNextAlarm);
      const cycles = executed(this.chip);
      this.cycles += cycles;
      // As `clock.tick` does it, but for the call where there is nothing to do.
      clock.nanosCounter += cycles * NANOS_OF_CYCLE;
      if (clock.nextAlarm !== null && clock.nextAlarm.nanos <= clock.nanosCounter) clock.tick(0);
    }
    return true;
  }

  /** Executes to the next mark. Whether it came; it must be this one. */
  runTo(mark, cyclesMax) {
    this.mark = 0;
    if (!this.runUntil(() => this.mark !== 0, cyclesMax)) return false;
    if (this.mark !== mark) throw new Error("the board was reset in the middle of a scan");
    return true;
  }

  /** Power, until the first scan starts. */
  powerUp(nowUs) {
    this.nowUs = nowUs;
    this.startUp();
    if (!this.runTo(SCAN_START, BOOT_MAX)) throw new Error("the firmware does not start");
    if (this.dataAt < SRAM) throw new Error("the firmware does not tell where its memory is");
    this.atStart = true;
  }

  /** To where the firmware's code begins to run in RAM: always the same, so it is done once. */
  startUp() {
    const { core, flashView, sram } = this.chip;
    core.VTOR = FLASH + VECTORS;
    core.SP = flashView.getUint32(VECTORS, true);
    core.PC = flashView.getUint32(VECTORS + 4, true) & ~1;
    const { firmware } = this;
    if (firmware.start === null) {
      // With the old layout it runs in flash, and comes to a mark.
      this.runUntil(() => core.PC >= SRAM || this.mark !== 0, BOOT_MAX);
      if (core.PC < SRAM) throw new Error("the firmware does not run in RAM");
      const { N, C, Z, V } = core;
      firmware.start = { sram: sram.slice(), registers: core.registers.slice(), flags: { N, C, Z, V } };
    } else {
      sram.set(firmware.start.sram);
      core.registers.set(firmware.start.registers);
      Object.assign(core, firmware.start.flags);
    }
  }

  setInputs(levels, counts) {
    for (let input = 0; input < POINTS; input++) {
      this.chip.gpio[FIRST_INPUT + input].setInputValue(((levels >> input) & 1) !== 0);
    }
    counts.forEach((count, channel) => {
      this.chip.adc.channelValues[channel] = count;
    });
  }

  data() {
    const at = this.dataAt - SRAM;
    return this.chip.sram.subarray(at, at + this.dataLen);
  }

  /** A scan. What is in `wanted` is done when it has started and has not read its inputs. */
  scan(wanted) {
    [this.nowUs, this.lookUs] = [wanted.nowUs, 0];
    if (!this.atStart && !this.runTo(SCAN_START, PAUSE_MAX)) {
      throw new Error("the next scan is not due yet: the program sets a longer period (//# scan)");
    }
    this.atStart = false;
    const start = this.cycles;
    this.setInputs(wanted.levels, wanted.counts);
    for (const { at, mask, value } of wanted.writes) {
      this.data()[at] = (this.data()[at] & ~mask) | (value & mask);
    }
    this.receive(wanted.characters);
    if (wanted.analog !== null) this.replaceAnalog(wanted.analog);
    this.isHeld = true;
    const hasEnded = this.runTo(SCAN_END, wanted.cyclesMax);
    this.isHeld = false;
    if (!hasEnded) {
      this.lookUs = LOOK_US;
      if (!this.runTo(SCAN_END, LATE_MAX)) throw new Error("the scan does not end, however late it is");
    }
    return this.cycles - start;
  }

  /** Characters come in on the serial line, as many as there are: none is late. */
  receive(characters) {
    const uart = this.chip.uart[0];
    for (let at = 0; at < characters.length; at += FIFO_LEN) {
      for (const character of characters.subarray(at, at + FIFO_LEN)) uart.feedByte(character);
      if (uart.interruptMask === 0) return;
      this.runUntil(() => uart.rxFIFO.empty, CHARACTERS_MAX);
    }
  }

  /** Lets the firmware convert and write its analog inputs, and makes them these. */
  replaceAnalog(bytes) {
    const data = this.data();
    for (const at of LAST_ANALOG) data[at] = NO_READING;
    this.mark = 0;
    const isWritten = () => this.mark !== 0 || LAST_ANALOG.every((at) => data[at] !== NO_READING);
    if (!this.runUntil(isWritten, INPUTS_MAX) || this.mark !== 0) {
      throw new Error("the firmware does not read its analog inputs");
    }
    data.set(bytes, ANALOG_AT);
  }

  /** The part of the time in thousandths that an output is high, where that is modulated. */
  duty(output) {
    const pin = FIRST_OUTPUT + output;
    if (this.chip.gpio[pin].functionSelect !== PWM) return NO_DUTY;
    const both = this.chip.readUint32(PWM_CC + ((pin >> 1) & 7) * PWM_SLICE_LEN);
    return pin & 1 ? both >>> 16 : both & 0xffff;
  }

  takeSent() {
    return Buffer.from(this.sent.splice(0));
  }
}

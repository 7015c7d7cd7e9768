// An ATmega328P as it is on an Uno, by avr8js: flash, EEPROM, pins, serial line, and a reset that
// is one. It runs for as long as it is told, and knows no firmware. There is no SPM and no sleep.
import {
  ADCMuxInputType,
  AVRADC,
  AVRClock,
  AVREEPROM,
  AVRIOPort,
  AVRTimer,
  AVRUSART,
  AVRWatchdog,
  CPU,
  EEPROMMemoryBackend,
  adcConfig,
  avrInstruction,
  clockConfig,
  eepromConfig,
  portBConfig,
  portDConfig,
  timer0Config,
  timer1Config,
  timer2Config,
  usart0Config,
  watchdogConfig,
} from "avr8js";

const HERTZ = 16_000_000;
export const CYCLES_PER_MS = HERTZ / 1000;
const FLASH_BYTES = 0x8000;
const SRAM_BYTES = 0x800;
const SRAM_START = 0x100;
const EEPROM_BYTES = 0x400;
/** MCUSR, and what it says of a reset: power, the reset pin. The watchdog says it itself. */
const MCUSR = 0x54;
const POWER_ON = 1 << 0;
const EXTERNAL = 1 << 1;
const WATCHDOG = 1 << 3;
/** GPIOR0, a register without function: firmware marks in it how far it is. */
const MARK = 0x3e;
/** D2, the first of six inputs, is PD2. */
const FIRST_INPUT = 2;
export const POINTS = 6;

/** What a reset makes anew: the core and what is around it on the chip. */
class Core {
  readonly cpu: CPU;
  readonly inputs: AVRIOPort;
  readonly usart: AVRUSART;
  /** The cycle until which it runs; a reset by itself ends that. */
  until = 0;
  isResetByItself = false;

  constructor(flash: Uint16Array, eeprom: EEPROMMemoryBackend, counts: Uint16Array) {
    const cpu = new CPU(flash, SRAM_BYTES);
    this.cpu = cpu;
    new AVRIOPort(cpu, portBConfig);
    this.inputs = new AVRIOPort(cpu, portDConfig);
    for (const config of [timer0Config, timer1Config, timer2Config]) new AVRTimer(cpu, config);
    new AVREEPROM(cpu, eeprom, eepromConfig);
    new AVRWatchdog(cpu, watchdogConfig, new AVRClock(cpu, HERTZ, clockConfig));
    const adc = new AVRADC(cpu, adcConfig);
    adc.onADCRead = (input) => {
      const isPin = input.type === ADCMuxInputType.SingleEnded;
      const value = isPin ? (counts[input.channel] ?? 0) : 0;
      cpu.addClockEvent(() => adc.completeADCRead(value), adc.sampleCycles);
    };
    this.usart = new AVRUSART(cpu, usart0Config, HERTZ);
    // The chip's own reset begins with the same registers as any other.
    cpu.reset = () => {
      this.isResetByItself = true;
      this.until = 0;
    };
  }
}

export class Chip {
  private flash = new Uint16Array(FLASH_BYTES / 2);
  private eeprom = new EEPROMMemoryBackend(EEPROM_BYTES);
  /** Of the channels of the converter: six of them are pins. */
  private counts = new Uint16Array(8);
  private levels = 0;
  private core: Core;
  /** Cycles before the last reset, so that time goes on. */
  private before = 0;
  private incoming: number[] = [];
  private sent: number[] = [];
  private isHeld = false;
  /** Is told what is written to GPIOR0, which has no function on the chip. */
  onMark: ((mark: number) => void) | undefined;

  /** Without power. */
  constructor() {
    this.core = this.anew(new Uint8Array(SRAM_BYTES), POWER_ON);
  }

  /** What the EEPROM holds. */
  get eepromBytes(): Uint8Array {
    return this.eeprom.memory;
  }

  /** Power comes, with this in the flash from address 0 on. The EEPROM is as it was. */
  powerOn(flash: Uint8Array): void {
    this.flash.fill(0xffff);
    new Uint8Array(this.flash.buffer).set(flash.subarray(0, FLASH_BYTES));
    this.before = 0;
    this.core = this.anew(new Uint8Array(SRAM_BYTES), POWER_ON);
  }

  /** The reset button: what is in SRAM stays. */
  reset(): void {
    this.restart(EXTERNAL);
  }

  /** Cycles since power came. */
  get cycles(): number {
    return this.before + this.core.cpu.cycles;
  }

  /** Data memory from address 0 on: registers of the core, registers of the chip, SRAM. */
  get data(): Uint8Array {
    return this.core.cpu.data;
  }

  /** Runs for so many cycles, or as many more as its last instruction takes. */
  run(cycles: number): void {
    const end = this.cycles + cycles;
    this.isHeld = false;
    while (this.cycles < end && !this.isHeld) {
      const { core } = this;
      const { cpu } = core;
      core.until = end - this.before;
      while (cpu.cycles < core.until) {
        avrInstruction(cpu);
        cpu.tick();
      }
      if (core.isResetByItself) this.restart(WATCHDOG);
    }
  }

  /** Ends [`run`] after this instruction: for `onMark`. */
  hold(): void {
    this.isHeld = true;
    this.core.until = 0;
  }

  /** The level at the pin of I0.`input`. */
  drive(input: number, isHigh: boolean): void {
    const bit = 1 << input;
    if (((this.levels & bit) !== 0) === isHigh) return;
    this.levels ^= bit;
    this.core.inputs.setPin(FIRST_INPUT + input, isHigh);
  }

  /** The voltage at an analog pin, in counts of the converter. */
  setCounts(channel: number, counts: number): void {
    this.counts[channel] = counts;
  }

  /** Bytes come on the serial line, one after the other. */
  receive(bytes: Iterable<number>): void {
    this.incoming.push(...bytes);
    if (!this.core.usart.rxBusy) this.receiveNext();
  }

  /** What has been sent since the last call. */
  takeSent(): Uint8Array {
    return Uint8Array.from(this.sent.splice(0));
  }

  private receiveNext(): void {
    // Where nobody listens bytes are lost.
    for (let byte = this.incoming.shift(); byte !== undefined; byte = this.incoming.shift())
      if (this.core.usart.writeByte(byte) === true) return;
  }

  private restart(cause: number): void {
    this.before += this.core.cpu.cycles;
    this.core = this.anew(this.data.slice(SRAM_START), cause);
  }

  private anew(sram: Uint8Array, cause: number): Core {
    const core = new Core(this.flash, this.eeprom, this.counts);
    core.cpu.data.set(sram, SRAM_START);
    core.cpu.data[MCUSR] = cause;
    for (let input = 0; input < POINTS; input++)
      core.inputs.setPin(FIRST_INPUT + input, ((this.levels >> input) & 1) !== 0);
    core.usart.onByteTransmit = (byte) => this.sent.push(byte);
    core.usart.onRxComplete = () => this.receiveNext();
    this.incoming = [];
    core.cpu.writeHooks[MARK] = (mark) => {
      this.onMark?.(mark);
      return false;
    };
    return core;
  }
}

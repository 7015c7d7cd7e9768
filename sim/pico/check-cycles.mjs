// Compares the cycles that `cycles.mjs` counts with the table of the Cortex-M0+ (ARM DDI 0484C,
// table 3-1), instruction by instruction, for memory without waiting and a multiplier of one cycle,
// as the RP2040 has them. Prints what differs, and how many were compared.

import { executed } from "./cycles.mjs";
import { RP2040 } from "rp2040js";

const SRAM = 0x20000000;
const CODE = SRAM + 0x1000;
const DATA = SRAM + 0x2000;
const STACK = SRAM + 0x3000;
const SIO_CPUID = 0xd0000000;
const SCS_CPUID = 0xe000ed00;
const NOP = 0xbf00;

// Registers before each: R0 is an address in SRAM, R1 a small number, R2 an address of code, R3 one
// of the port that the processor has of its own.
const before = [DATA, 4, (CODE + 0x40) | 1, SIO_CPUID, SCS_CPUID, 1, 1, 1];

/** Name, halfwords, cycles; what else is to be so before it. */
const TABLE = [
  ["MOVS Rd, #imm", [0x2101], 1],
  ["MOVS Rd, Rm", [0x000d], 1],
  ["MOV Rd, Rm", [0x4688], 1],
  ["MOV PC, Rm", [0x4697], 2],
  ["ADDS Rd, Rn, #imm", [0x1c4d], 1],
  ["ADDS Rd, Rn, Rm", [0x184d], 1],
  ["ADD Rd, Rm", [0x4488], 1],
  ["ADD PC, Rm", [0x448f], 2],
  ["ADDS Rd, #imm", [0x3101], 1],
  ["ADCS", [0x414d], 1],
  ["ADD SP, #imm", [0xb001], 1],
  ["ADD Rd, SP, #imm", [0xa901], 1],
  ["ADR", [0xa101], 1],
  ["SUBS Rd, Rn, Rm", [0x1a4d], 1],
  ["SUBS Rd, Rn, #imm", [0x1e4d], 1],
  ["SUBS Rd, #imm", [0x3901], 1],
  ["SBCS", [0x418d], 1],
  ["SUB SP, #imm", [0xb081], 1],
  ["RSBS", [0x424d], 1],
  ["MULS", [0x434d], 1],
  ["CMP Rn, Rm", [0x428d], 1],
  ["CMP, registers above R7", [0x4588], 1],
  ["CMN", [0x42cd], 1],
  ["CMP Rn, #imm", [0x2901], 1],
  ["ANDS", [0x400d], 1],
  ["EORS", [0x404d], 1],
  ["ORRS", [0x430d], 1],
  ["BICS", [0x438d], 1],
  ["MVNS", [0x43cd], 1],
  ["TST", [0x420d], 1],
  ["LSLS Rd, Rm, #imm", [0x004d], 1],
  ["LSLS Rd, Rs", [0x408d], 1],
  ["LSRS Rd, Rm, #imm", [0x084d], 1],
  ["LSRS Rd, Rs", [0x40cd], 1],
  ["ASRS Rd, Rm, #imm", [0x104d], 1],
  ["ASRS Rd, Rs", [0x410d], 1],
  ["RORS", [0x41cd], 1],
  ["LDR Rd, [Rn, #imm]", [0x6805], 2],
  ["LDRH Rd, [Rn, #imm]", [0x8805], 2],
  ["LDRB Rd, [Rn, #imm]", [0x7805], 2],
  ["LDR Rd, [Rn, Rm]", [0x5845], 2],
  ["LDRH Rd, [Rn, Rm]", [0x5a45], 2],
  ["LDRSH Rd, [Rn, Rm]", [0x5e45], 2],
  ["LDRB Rd, [Rn, Rm]", [0x5c45], 2],
  ["LDRSB Rd, [Rn, Rm]", [0x5645], 2],
  ["LDR Rd, literal", [0x4d01], 2],
  ["LDR Rd, [SP, #imm]", [0x9d01], 2],
  ["LDR of the single-cycle port", [0x681d], 1],
  ["LDR of the processor's own registers", [0x6825], 2],
  ["LDM, one", [0xc820], 2],
  ["LDM, four", [0xc8f0], 5],
  ["STR Rd, [Rn, #imm]", [0x6005], 2],
  ["STRH Rd, [Rn, #imm]", [0x8005], 2],
  ["STRB Rd, [Rn, #imm]", [0x7005], 2],
  ["STR Rd, [Rn, Rm]", [0x5045], 2],
  ["STRH Rd, [Rn, Rm]", [0x5245], 2],
  ["STRB Rd, [Rn, Rm]", [0x5445], 2],
  ["STR Rd, [SP, #imm]", [0x9501], 2],
  ["STM, one", [0xc020], 2],
  ["STM, four", [0xc0f0], 5],
  ["PUSH, one", [0xb410], 2],
  ["PUSH, four", [0xb4f0], 5],
  ["PUSH LR", [0xb500], 2],
  ["PUSH, four and LR", [0xb5f0], 6],
  ["POP, one", [0xbc10], 2],
  ["POP, four", [0xbcf0], 5],
  ["POP PC", [0xbd00], 4],
  ["POP, four and PC", [0xbdf0], 8],
  ["B, condition that is so", [0xd001], 2, { Z: true }],
  ["B, condition that is not so", [0xd001], 1, { Z: false }],
  ["B", [0xe001], 2],
  ["BL", [0xf000, 0xf802], 3],
  ["BX", [0x4710], 2],
  ["BLX", [0x4790], 2],
  ["SXTH", [0xb20d], 1],
  ["SXTB", [0xb24d], 1],
  ["UXTH", [0xb28d], 1],
  ["UXTB", [0xb2cd], 1],
  ["REV", [0xba0d], 1],
  ["REV16", [0xba4d], 1],
  ["REVSH", [0xbacd], 1],
  ["CPSID", [0xb672], 1],
  ["CPSIE", [0xb662], 1],
  ["MRS", [0xf3ef, 0x8510], 3],
  ["MSR", [0xf385, 0x8810], 3],
  ["NOP", [NOP], 1],
  ["SEV", [0xbf40], 1],
  ["WFE", [0xbf20], 2],
  ["WFI", [0xbf30], 2],
  ["YIELD", [0xbf10], 1],
  ["DMB", [0xf3bf, 0x8f5f], 3],
  ["DSB", [0xf3bf, 0x8f4f], 3],
  ["ISB", [0xf3bf, 0x8f6f], 3],
];

function cyclesOf(halfwords, state) {
  const chip = new RP2040();
  chip.logger = { debug() {}, info() {}, warn() { throw new Error("no instruction"); }, error() {} };
  const { core } = chip;
  for (let at = CODE; at < CODE + 0x80; at += 2) chip.writeUint16(at, NOP);
  halfwords.forEach((halfword, at) => chip.writeUint16(CODE + 2 * at, halfword));
  for (let at = STACK; at < STACK + 0x40; at += 4) chip.writeUint32(at, CODE | 1);
  before.forEach((value, register) => {
    core.registers[register] = value;
  });
  Object.assign(core, { PC: CODE, SP: STACK, LR: CODE | 1 }, state);
  return executed(chip);
}

let different = 0;
for (const [name, halfwords, cycles, state] of TABLE) {
  const counted = cyclesOf(halfwords, state ?? {});
  if (counted !== cycles) {
    different += 1;
    console.log(`${name}: ${counted} cycles, the table says ${cycles}`);
  }
}
console.log(`${TABLE.length} compared, ${different} different`);
process.exitCode = different > 0 ? 1 : 0;

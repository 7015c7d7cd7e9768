// Executes one instruction and tells the cycles that the processor takes for it. rp2040js counts as
// the table of the Cortex-M0+ says (ARM DDI 0484C, table 3-1), but for two instructions, which are
// corrected here: PUSH with LR and POP with PC, where it leaves out the one for that register.
// `check-cycles.mjs` compares with the whole table.

const SRAM = 0x20000000;
// Their upper bytes.
const PUSH_LR = 0xb5;
const POP_PC = 0xbd;

/** Executes the next instruction of a chip. Code of these two is in SRAM. */
export function executed({ core, sram }) {
  const upper = sram[core.PC - SRAM + 1];
  const cycles = core.executeInstruction();
  return upper === PUSH_LR || upper === POP_PC ? cycles + 1 : cycles;
}

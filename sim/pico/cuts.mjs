// Programs over the line, and power that is cut meanwhile: `node cuts.mjs FIRMWARE OLD NEW CUTS`. While
// NEW is written to a board that runs OLD, the power is cut at some byte of flash, again and again on
// new boards. Prints how often which of them runs after that; another state is an error.

import { readFileSync } from "node:fs";
import { Board, CYCLES_OF_US, firmwareAt, load } from "./board.mjs";
import { frame } from "./frame.mjs";
import { Cut } from "./rom.mjs";

const DATA_LEN = 16128;
const BLOCK = 240;
const DOWNLOAD = 101;
const IDENTIFY = 65;
// Silence ends a frame, and an answer comes after that; a whole program is checked in less.
const SILENCE = 3_000 * CYCLES_OF_US;
const PATIENCE = 500_000 * CYCLES_OF_US;
// Bytes of flash that are written at once: the record is the last that is.
const PAGE = 256;
const RUNS = 1;

const bytesOf = (word) => [word >> 8, word & 0xff];

/** What a board answers, without unit and checksum. */
function ask(board, request) {
  board.takeSent();
  board.receive(Buffer.from(frame(request)));
  board.runUntil(() => board.sent.length > 0, PATIENCE);
  board.runUntil(() => false, SILENCE);
  // The emulator sends characters at once: an answer is there as soon as it is written.
  return [...board.takeSent()].slice(1, -2);
}

/** Writes a program, and gives the answer to its end. */
function download(board, image) {
  ask(board, [DOWNLOAD, 1, ...bytesOf(image.length)]);
  for (let at = 0; at < image.length; at += BLOCK) {
    const block = image.subarray(at, at + BLOCK);
    ask(board, [DOWNLOAD, 2, ...bytesOf(at), block.length, ...block]);
  }
  return ask(board, [DOWNLOAD, 3]);
}

/** The checksum of the program that runs; empty: none does. */
function running(board) {
  const identity = ask(board, [IDENTIFY]);
  return identity[3] & RUNS ? identity.slice(-4).map((byte) => byte.toString(16)).join(" ") : "";
}

function on(board) {
  board.powerUp(0);
  board.freeClock();
  return board;
}

/** A board with the old program in its first slot, or by its line in the second one. */
function withOld(isByLine) {
  const board = on(new Board(firmwareAt(elf), isByLine ? newer : old, DATA_LEN));
  if (isByLine) download(board, old);
  return board;
}

const [elf, oldFile, newFile, cuts] = process.argv.slice(2);
await load();
const [old, newer] = [readFileSync(oldFile), readFileSync(newFile)];
const boards = [withOld(false), withOld(true)];
const [oldSum] = boards.map(running);
const whole = on(boards[0].again());
whole.power.bytes = Number.MAX_SAFE_INTEGER;
download(whole, newer);
const work = Number.MAX_SAFE_INTEGER - whole.power.bytes;
const newSum = running(whole);
const found = { [oldSum]: 0, [newSum]: 0 };
for (let cut = 0; cut < Number(cuts); cut++) {
  const board = on(boards[cut % 2].again());
  // Half of them in the record, of which the first bytes are not blank.
  board.power.bytes = cut % 4 < 2 ? work - PAGE + (cut >> 2) : Math.floor((cut * work) / cuts);
  try {
    download(board, newer);
    throw new Error(`cut ${cut}: the power was not cut`);
  } catch (error) {
    if (!(error instanceof Cut)) throw error;
  }
  const sum = running(on(board.again()));
  if (!(sum in found)) throw new Error(`cut ${cut}: neither program runs: ${sum}`);
  found[sum] += 1;
}
console.log(`${cuts} cuts: ${found[oldSum]} old, ${found[newSum]} new`);

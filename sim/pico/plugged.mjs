// A Pico that is plugged in, with a clock that is free: `node plugged.mjs uart|usb FIRMWARE IMAGE`. Its
// first or its second line is standard input and output. It is some times slower than a real one.

import { readFileSync } from "node:fs";
import { Board, CYCLES_OF_US, firmwareAt, load } from "./board.mjs";

const DATA_LEN = 16128;
// A character of 10 bits at 115200 baud.
const CHARACTER = 87 * CYCLES_OF_US;
// So long it runs between two looks at standard input.
const TURN = 250_000;

const [line, elf, image] = process.argv.slice(2);
await load();
const board = new Board(firmwareAt(elf), readFileSync(image), DATA_LEN);
if (line === "usb") board.plugIn();
board.powerUp(0);
board.freeClock();

const incoming = [];
process.stdin.on("data", (characters) => incoming.push(...characters));
process.stdin.on("end", () => process.exit());

let due = 0;

/** Characters at the pin of the UART, each when it is time. */
function runWithUart(end) {
  while (board.cycles < end) {
    const isBusy = incoming.length > 0;
    if (isBusy && board.cycles >= due) {
      board.chip.uart[0].feedByte(incoming.shift());
      due = board.cycles + CHARACTER;
    }
    board.runUntil(() => false, isBusy ? due - board.cycles : end - board.cycles);
  }
  return board.takeSent();
}

/** Packets, each when there is a place for one. */
function runWithUsb(end) {
  board.sendByUsb(incoming.splice(0));
  board.runUntil(() => false, end - board.cycles);
  return Buffer.from(board.sentByUsb.splice(0));
}

const run = line === "usb" ? runWithUsb : runWithUart;

function turn() {
  const sent = run(board.cycles + TURN);
  if (sent.length > 0) process.stdout.write(sent);
  setImmediate(turn);
}

turn();

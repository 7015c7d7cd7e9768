// How even the starts of scans are that have a fixed period, while a master asks for as much as it
// can: `node jitter.mjs uart|usb FIRMWARE IMAGE PERIOD_MS SCANS`. The clock is free. Prints the number
// of scans and answers, and how many microseconds the starts are apart from a period that is kept.

import { readFileSync } from "node:fs";
import { Board, CYCLES_OF_US, SCAN_START, firmwareAt, load } from "./board.mjs";
import { frame } from "./frame.mjs";

const DATA_LEN = 16128;
// The first scans find the period.
const FIRST_SCANS = 5;
// A character of 10 bits at 115200 baud.
const CHARACTER = 87 * CYCLES_OF_US;
// Until an answer has begun.
const SILENCE = 5_000 * CYCLES_OF_US;
// A pause that ends an answer, and by how much more the next question is later each time.
const PAUSE = 2_000 * CYCLES_OF_US;
const SHIFT = 37 * CYCLES_OF_US;
const SHIFTS = 101;

// Functions with the longest answers of Modbus, and of the service functions.
const QUESTIONS = [
  [1, 0x07, 0xd0, 0x01, 0x00],
  [3, 0, 0, 0, 125],
  [4, 0, 0, 0, 3],
  [43, 14, 1, 0],
  [65],
  [68, 0, 0, 0, 0, 250],
];

const [line, elf, image, period, scans] = process.argv.slice(2);

/** Whether something has come from the board. */
function heard(board) {
  const sent = line === "usb" ? board.sentByUsb.splice(0) : board.takeSent();
  return sent.length > 0;
}

/** Sends what can be sent at once: a character, or packets. */
function send(board, characters) {
  if (line === "usb") board.sendByUsb(characters.splice(0));
  else board.chip.uart[0].feedByte(characters.shift());
}

/** A master: it asks as soon as it has heard an answer. */
class Master {
  constructor(board) {
    [this.board, this.number, this.waiting, this.answers] = [board, 0, [], 0];
    [this.due, this.isHearing] = [board.cycles, false];
  }

  step() {
    const { board } = this;
    const hears = heard(board);
    if (this.waiting.length > 0) {
      send(board, this.waiting);
      this.due = board.cycles + (this.waiting.length > 0 ? CHARACTER : SILENCE);
    } else if (hears) {
      this.isHearing = true;
      this.due = board.cycles + PAUSE;
    } else {
      this.answers += this.isHearing ? 1 : 0;
      this.isHearing = false;
      this.waiting = frame(QUESTIONS[this.number % QUESTIONS.length]);
      this.number += 1;
      this.due = board.cycles + ((this.number * 17) % SHIFTS) * SHIFT;
    }
  }
}

await load();
const board = new Board(firmwareAt(elf), readFileSync(image), DATA_LEN);
if (line === "usb") board.plugIn();
board.powerUp(0);
board.freeClock();
const master = new Master(board);
const starts = [];
const second = 1_000_000 * CYCLES_OF_US;
while (starts.length < Number(scans) + FIRST_SCANS) {
  board.mark = 0;
  const hasCome = () => board.mark === SCAN_START || board.cycles >= master.due;
  if (!board.runUntil(hasCome, second)) throw new Error("the board does not scan");
  if (board.mark === SCAN_START) starts.push(board.cycles / CYCLES_OF_US);
  if (board.cycles >= master.due) master.step();
}
const late = starts.slice(FIRST_SCANS).map((us, scan) => us - scan * Number(period) * 1000);
const apart = Math.max(...late) - Math.min(...late);
console.log(`${late.length} scans, ${master.answers} answers, ${apart.toFixed(1)} us apart`);

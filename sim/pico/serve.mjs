// The Pico for awl-sim: what a board is asked for comes in frames on standard input, the answers go
// out on standard output; `frames.rs` in sim/src/machine/pico is the other side. One process serves
// many boards, one after the other.

import { readSync, writeSync } from "node:fs";
import { ANALOG_LEN, Board, FIRST_OUTPUT, POINTS, firmwareAt, load } from "./board.mjs";

/** What there is to tell after a scan. */
function told(board, cycles) {
  const { sio } = board.chip;
  const sent = board.takeSent();
  const head = Buffer.alloc(34 + sent.length);
  head[0] = (sio.gpioValue >> FIRST_OUTPUT) & 0xff;
  head[1] = (sio.gpioOutputEnable >> FIRST_OUTPUT) & 0xff;
  head.writeUInt32LE(board.scratch[0], 2);
  head.writeUInt32LE(board.scratch[1], 6);
  head.writeUInt32LE(Math.min(cycles, 0xffffffff), 10);
  for (let output = 0; output < POINTS; output++) head.writeUInt16LE(board.duty(output), 14 + 2 * output);
  head.writeUInt32LE(sent.length, 30);
  head.set(sent, 34);
  return [head, board.data()];
}

/** Reads the parts of a request one after the other. */
class Parts {
  constructor(bytes) {
    [this.bytes, this.at] = [bytes, 0];
  }

  take(len) {
    this.at += len;
    if (this.at > this.bytes.length) throw new Error("a request is too short");
    return this.bytes.subarray(this.at - len, this.at);
  }

  byte() {
    return this.take(1)[0];
  }

  short() {
    return this.take(2).readUInt16LE();
  }

  long() {
    return this.take(4).readUInt32LE();
  }

  rest() {
    return this.take(this.bytes.length - this.at);
  }

  list(one) {
    return Array.from({ length: this.short() }, one);
  }
}

let board = null;

const requests = {
  // Power comes to a new board.
  1(parts) {
    board = null;
    const firmware = firmwareAt(parts.take(parts.short()).toString());
    const [dataLen, nowUs, levels] = [parts.short(), parts.long(), parts.byte()];
    const counts = parts.list(() => parts.short());
    board = new Board(firmware, parts.rest(), dataLen);
    board.setInputs(levels, counts);
    board.powerUp(nowUs);
    return told(board, 0);
  },
  // A scan.
  2(parts) {
    if (board === null) throw new Error("there is no board yet");
    const [nowUs, cyclesMax, levels] = [parts.long(), parts.long(), parts.byte()];
    const counts = parts.list(() => parts.short());
    const writes = parts.list(() => ({ at: parts.short(), mask: parts.byte(), value: parts.byte() }));
    const analog = parts.byte() === 0 ? null : parts.take(ANALOG_LEN);
    const characters = parts.rest();
    return told(board, board.scan({ nowUs, cyclesMax, levels, counts, writes, analog, characters }));
  },
};

/** So many bytes of standard input; `null` at its end. */
function read(len) {
  const bytes = Buffer.alloc(len);
  for (let at = 0; at < len; ) {
    const count = readSync(0, bytes, at, len - at, null);
    if (count === 0) return null;
    at += count;
  }
  return bytes;
}

/** An answer: whether it is one, and its bytes. */
function write(kind, parts) {
  const head = Buffer.alloc(5);
  head.writeUInt32LE(1 + parts.reduce((sum, part) => sum + part.length, 0));
  head[4] = kind;
  const bytes = Buffer.concat([head, ...parts]);
  for (let at = 0; at < bytes.length; ) at += writeSync(1, bytes, at);
}

function answer(make) {
  try {
    write(0, make());
  } catch (error) {
    write(1, [Buffer.from(error.message)]);
  }
}

function serve() {
  for (let head = read(4); head !== null; head = read(4)) {
    const request = read(head.readUInt32LE());
    if (request === null) return;
    answer(() => requests[request[0]](new Parts(request.subarray(1))));
  }
}

/** Whether the emulator is there. */
async function isLoaded() {
  try {
    await load();
    write(0, []);
    return true;
  } catch (error) {
    const isMissing = error.code === "ERR_MODULE_NOT_FOUND";
    write(1, [Buffer.from(isMissing ? "a package is not installed" : error.message)]);
    return false;
  }
}

if (await isLoaded()) serve();

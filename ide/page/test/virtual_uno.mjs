// The virtual Uno as the page's worker has it, in node and in a time that the test gives: what a
// board does beside scans. `node test/virtual_uno.mjs FOLDER`; in the folder is what a page loads.
import assert from "node:assert/strict";
import { innerFolder, loadCore, loadSource } from "./load.mjs";

/** Until the firmware has checked its program, and has answered. */
const BOOT_MS = 700;

const folder = await innerFolder(process.argv[2]);
const { Ide } = await loadCore(folder);
const { VirtualUno } = await loadSource("src/board/virtual_uno.ts");

/** A page without pixels, with its worker. */
class Page {
  ide = new Ide();
  uno = new VirtualUno();
  now = 0;
  last = {};
  samples = [];
  refused;

  constructor(text) {
    this.tell("open", { files: [{ name: "p.awl", text }], main: null });
    this.tell("target", { kind: "virtualUno" });
  }

  tell(wish, more = {}) {
    this.refused = undefined;
    this.take(this.ide.request(JSON.stringify({ id: 1, do: wish, ...more }), this.now));
    assert.equal(this.refused, undefined);
  }

  take(json) {
    for (const event of JSON.parse(json)) {
      if (event.is === "samples") this.samples.push(event);
      if (event.is === "refused") this.refused = event.message;
      if (!this.uno.take(event, this.ide)) this.last[event.is] = event;
    }
  }

  pass(ms) {
    for (const end = this.now + ms; this.now < end;) {
      this.now += 10;
      this.take(this.ide.tick(this.now, 1000));
      this.uno.goOn(this.ide, Infinity, (bytes) => this.take(this.ide.receive(bytes, this.now)));
    }
  }

  get status() {
    return this.last.status.status;
  }

  watch(...operands) {
    this.tell("watch", { operands });
    this.pass(400);
    return this.last.watched.values.map((value) => value.text);
  }

  edit(text) {
    this.tell("edit", { file: "p.awl", text });
    this.tell("download");
    this.pass(BOOT_MS);
  }
}

const tests = {
  "rate, parity and address are those of the program"() {
    for (const line of ["address 5", "baud 9600 parity even", "address 247 baud 19200"]) {
      const page = new Page(`//# modbus ${line}\nLD I0.0\n= Q0.0\n`);
      page.tell("run");
      page.pass(BOOT_MS);
      assert.equal(page.status.mode, "RUN", line);
      page.tell("drive", { operand: "I0.0", value: 1 });
      assert.deepEqual(page.watch("Q0.0"), ["1"], line);
    }
  },

  "inverted points are logical to people and electrical at the pins"() {
    const page = new Page("//# invert Q0.0, I0.1\nLD I0.1\n= Q0.0\n");
    page.tell("run");
    page.pass(BOOT_MS);
    const pins = () => [page.last.pins.inputs, page.last.pins.outputs];
    assert.deepEqual(pins(), [0, 0]);
    page.tell("drive", { operand: "I0.1", value: 1 });
    page.pass(200);
    assert.deepEqual(pins(), [2, 1]);
    assert.equal(page.ide.chipPins()[0] & 2, 0, "the pin is low");
  },

  "analog inputs come through the converter, analog outputs through timer 1"() {
    const page = new Page("LD SM0.0\nMOVW AIW0, VW0\nMOVW AIW0, AQW2\n");
    page.tell("drive", { operand: "Ain0", value: 512 });
    page.tell("run");
    page.pass(BOOT_MS);
    assert.deepEqual(page.watch("Ain0", "VW0"), ["512", "16016"]);
    const [duty] = page.last.pins.pwm;
    assert(Math.abs(duty - 500) <= 1, `${duty}`);
  },

  "the oscilloscope has a sample every 10 ms, however fast time goes"() {
    const page = new Page("LD SM0.0\nINCW MW0\n");
    page.tell("speed", { factor: 10 });
    page.tell("run");
    page.pass(BOOT_MS);
    page.tell("scope", { signals: ["MW0"], everyMs: 10 });
    page.samples = [];
    page.pass(500);
    const count = page.samples.reduce((sum, samples) => sum + samples.times.length, 0);
    const lost = page.samples.filter((samples) => samples.lost).length;
    assert(count > 450 && lost === 0, `${count} in 5 s, ${lost} gaps`);
  },

  "what is retained outlives a reset and another download, in EEPROM"() {
    const counting = "//# retain VB0-VB1\nLD I0.0\nEU\nINCW VW0\n";
    const page = new Page(counting);
    page.tell("run");
    page.pass(BOOT_MS);
    for (const value of [1, 0, 1, 0, 1]) {
      page.tell("drive", { operand: "I0.0", value });
      page.pass(100);
    }
    assert.deepEqual(page.watch("VW0"), ["3"]);
    // Long enough to be saved.
    page.pass(70_000);
    page.tell("reset");
    page.pass(BOOT_MS);
    assert.deepEqual(page.watch("VW0"), ["3"]);
    page.edit(`// again\n${counting}`);
    assert.deepEqual(page.watch("VW0"), ["3"], "the same program");
  },

  "a loop without end is a fault, and told at its line"() {
    const page = new Page("LD SM0.0\nLBL 1\nLD SM0.0\nJMP 1\n");
    page.tell("run");
    page.pass(1500);
    assert.equal(page.status.mode, "STOP");
    assert.match(page.status.fault, /p\.awl:4/);
    assert.equal(page.status.faultAt.file, "p.awl");
    page.edit("LD I0.0\n= Q0.0\n");
    assert.deepEqual([page.status.mode, page.status.fault], ["RUN", null]);
  },

  "a pause stands still, slow motion is slow, and unplugging ends it"() {
    const page = new Page("LD SM0.0\nINCW MW0\n");
    page.tell("run");
    page.pass(BOOT_MS);
    page.tell("speed", { factor: 0.1 });
    const { timeMs } = page.status;
    page.pass(2000);
    const passed = page.status.timeMs - timeMs;
    assert(passed > 190 && passed <= 210 && page.status.mode === "RUN", `${passed}`);
    page.tell("pause", { on: true });
    page.pass(100);
    const paused = page.status.timeMs;
    page.pass(1000);
    assert.deepEqual([page.status.mode, page.status.timeMs], ["PAUSE", paused]);
    page.tell("disconnect");
    page.pass(100);
    assert.deepEqual([page.status.mode, page.uno.isOn], ["OFFLINE", false]);
  },
};

for (const [name, test] of Object.entries(tests)) {
  test();
  console.log(`virtual Uno: ${name}`);
}

// Its speed, in time of the processor: other work on the computer does not count.
const ide = new Ide();
const ask = (wish) => JSON.parse(ide.request(JSON.stringify({ id: 1, ...wish }), 0));
ask({ do: "open", files: [{ name: "speed.awl", text: "LD I0.0\n= Q0.0\n" }], main: null });
ask({ do: "target", kind: "virtualUno" });
const { flash } = ask({ do: "connect" }).find((event) => event.is === "powerOn");
const { Chip, CYCLES_PER_MS } = await loadSource("src/board/chip.ts");
const chip = new Chip();
chip.powerOn(Uint8Array.from(flash));
let best = 0;
for (let round = 0; round < 5; round++) {
  const before = process.cpuUsage();
  for (let ms = 0; ms < 1000; ms++) chip.run(CYCLES_PER_MS);
  const { user, system } = process.cpuUsage(before);
  best = Math.max(best, 1e6 / (user + system));
}
console.log(`the virtual Uno in a second of the processor: ${best.toFixed(1)} s`);
assert(best >= 1, "the virtual Uno is slower than a real one");

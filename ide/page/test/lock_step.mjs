// Every example on the reference interpreter and on the shipped firmware, which runs on avr8js as
// in the page: scan by scan with the same times and inputs, every operand that the program uses.
// And how fast the chip is. `node test/lock_step.mjs FOLDER`; in the folder is what a page loads.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { innerFolder, loadCore, loadSource } from "./load.mjs";

const folder = await innerFolder(process.argv[2]);
/** How long an example runs whose scenario is about what only time on the board itself brings. */
const FOR_MS = 5000;
const ONLY_IN_REAL_TIME = /takes no (pulses|characters|setting)|does not show what/;
/** So many examples have a scenario that goes in lock-step; the rest are run without. */
const WITH_SCENARIO_MIN = 10;

const { Chip, CYCLES_PER_MS } = await loadSource("src/board/chip.ts");
const core = await loadCore(folder);

/** A chip as the core drives it. */
class Driven {
  chip = new Chip();
  mark = 0;

  constructor() {
    this.chip.onMark = (mark) => {
      this.mark = mark;
      this.chip.hold();
    };
  }

  powerOn(flash) {
    this.chip.powerOn(flash);
  }

  run(cycles) {
    this.mark = 0;
    this.chip.run(cycles);
    return this.mark;
  }

  data() {
    return this.chip.data;
  }

  write(address, byte) {
    this.chip.data[address] = byte;
  }

  drive(levels, counts) {
    for (let input = 0; input < 6; input++) this.chip.drive(input, ((levels >> input) & 1) !== 0);
    for (const [channel, count] of counts.entries()) this.chip.setCounts(channel, count);
  }
}

const projects = JSON.parse(await readFile(join(folder, "examples/list.json"), "utf8"));
let withScenario = 0;
for (const name of projects) {
  const project = JSON.parse(await readFile(join(folder, `examples/${name}.json`), "utf8"));
  const ide = new core.Ide();
  const wish = { id: 1, do: "open", files: project.files, main: project.main };
  ide.request(JSON.stringify(wish), 0);
  const compare = (scenario, plant) => ide.compare(new Driven(), scenario, FOR_MS, plant);
  const scenario = project.files.find((file) => file.name.endsWith(".scn"))?.name;
  let how = `with ${scenario}`;
  let result;
  try {
    result = scenario && compare(scenario, undefined);
    if (result) withScenario += 1;
  } catch (refusal) {
    if (!ONLY_IN_REAL_TIME.test(refusal)) throw new Error(`${name} ${how}:\n${refusal}`);
  }
  if (!result) {
    how = "without its scenario";
    result = compare(undefined, project.plant ?? undefined);
  }
  const [scans, operands] = result;
  assert(scans > 0 && operands > 0, name);
  console.log(`${name}: ${operands} operands the same after each of ${scans} scans, ${how}`);
}
assert(withScenario >= WITH_SCENARIO_MIN, `${withScenario} with their scenarios`);

// Its speed, in time of the processor: other work on the computer does not count.
const ide = new core.Ide();
const ask = (wish) => JSON.parse(ide.request(JSON.stringify({ id: 1, ...wish }), 0));
ask({ do: "open", files: [{ name: "speed.awl", text: "LD I0.0\n= Q0.0\n" }], main: null });
ask({ do: "target", kind: "virtualUno" });
const { flash } = ask({ do: "connect" }).find((event) => event.is === "powerOn");
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

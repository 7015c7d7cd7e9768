// Every example on the reference interpreter and on the shipped firmware, which runs on avr8js as
// in the page: scan by scan with the same times and inputs, every operand that the program uses.
// And how fast the chip is. `node test/lock_step.mjs FOLDER`; in the folder is what a page loads.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { build } from "esbuild";

const [, , folder] = process.argv;
/** How long an example runs whose scenario is about what only time on the board itself brings. */
const FOR_MS = 5000;
const ONLY_IN_REAL_TIME = /takes no (pulses|characters|setting)|does not show what/;
/** So many examples have a scenario that goes in lock-step; the rest are run without. */
const WITH_SCENARIO_MIN = 10;

const load = (text) =>
  import(`data:text/javascript;base64,${Buffer.from(text).toString("base64")}`);
const bundle = await build({
  entryPoints: ["src/board/chip.ts"],
  bundle: true,
  format: "esm",
  write: false,
  logLevel: "warning",
});
const { Chip, CYCLES_PER_MS } = await load(bundle.outputFiles[0].text);
const core = await load(await readFile(join(folder, "ide_core.js"), "utf8"));
await core.default({ module_or_path: await readFile(join(folder, "ide_core_bg.wasm")) });

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
const { flash } = JSON.parse(
  (() => {
    const ide = new core.Ide();
    ide.request(JSON.stringify({ id: 1, do: "target", kind: "virtualUno" }), 0);
    const files = [{ name: "speed.awl", text: "LD I0.0\n= Q0.0\n" }];
    ide.request(JSON.stringify({ id: 2, do: "open", files, main: null }), 0);
    return ide.request(JSON.stringify({ id: 3, do: "connect" }), 0);
  })(),
).find((event) => event.is === "powerOn");
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

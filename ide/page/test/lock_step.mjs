// Every example in a page of a real Chromium, on the reference interpreter and on the shipped firmware,
// which runs on avr8js: scan by scan with the same times and inputs, every operand that the program
// uses. `node test/lock_step.mjs ADDRESS FOLDER`: a server, and the folder that it gives away.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { open } from "./browser.mjs";
import { bundled, innerFolder } from "./load.mjs";

const [, , address, given] = process.argv;
const folder = await innerFolder(given);
/** How long an example runs whose scenario is about what only time on the board itself brings. */
const FOR_MS = 5000;
const ONLY_IN_REAL_TIME = /takes no (pulses|characters|setting)|does not show what/;
/** So many examples have a scenario that goes in lock-step; the rest are run without. */
const WITH_SCENARIO_MIN = 10;

// Core and chip without the page around them: in a text of its server, which allows no foreign code.
const { browser, page, errors } = await open({ bypassCSP: true });
await page.route("**/favicon.ico", (route) => route.fulfill({ status: 204 }));
await page.goto(new URL("sw.js", address).href);
const contents = `
  import init, { Ide } from ${JSON.stringify(join(folder, "ide_core.js"))};
  import { Driven } from "./test/driven.mjs";
  globalThis.begin = (bytes) => init({ module_or_path: Uint8Array.from(bytes) });
  globalThis.compare = (project, scenario, forMs, plant) => {
    const ide = new Ide();
    const wish = { id: 1, do: "open", files: project.files, main: project.main };
    ide.request(JSON.stringify(wish), 0);
    try {
      return { same: [...ide.compare(new Driven(), scenario, forMs, plant)] };
    } catch (refusal) {
      return { refusal: String(refusal) };
    }
  };`;
const stdin = { contents, resolveDir: process.cwd() };
// The core would look for its file beside itself.
const define = { "import.meta.url": '"http://core/"' };
await page.addScriptTag({ content: await bundled({ format: "iife", stdin, define }) });
const core = await readFile(join(folder, "ide_core_bg.wasm"));
await page.evaluate(async (text) => {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  await globalThis.begin(bytes);
}, core.toString("base64"));
const compare = (project, scenario, plant) =>
  page.evaluate(
    ([project, scenario, forMs, plant]) =>
      globalThis.compare(project, scenario ?? undefined, forMs, plant ?? undefined),
    [project, scenario, FOR_MS, plant],
  );

const projects = JSON.parse(await readFile(join(folder, "examples/list.json"), "utf8"));
let withScenario = 0;
for (const name of projects) {
  const project = JSON.parse(await readFile(join(folder, `examples/${name}.json`), "utf8"));
  const scenario = project.files.find((file) => file.name.endsWith(".scn"))?.name;
  let how = `with ${scenario}`;
  let found = scenario ? await compare(project, scenario, null) : {};
  if (found.same) withScenario += 1;
  else {
    if (scenario && !ONLY_IN_REAL_TIME.test(found.refusal))
      throw new Error(`${name} ${how}:\n${found.refusal}`);
    how = "without its scenario";
    found = await compare(project, null, project.plant);
  }
  const [scans, operands] = found.same ?? [];
  assert(scans > 0 && operands > 0, `${name}: ${found.refusal}`);
  console.log(`${name}: ${operands} operands the same after each of ${scans} scans, ${how}`);
}
assert(withScenario >= WITH_SCENARIO_MIN, `${withScenario} with their scenarios`);
assert.deepEqual(errors, []);
await browser.close();

// Charts as drawings, in a real Chromium on the real core: steps that are active on the simulator
// and on the virtual Uno, the way from a step to its line and back, zoom, keyboard, languages.
// `node test/charts.mjs ADDRESS`.
import assert from "node:assert/strict";
import { controls, open } from "./browser.mjs";

const [, , given] = process.argv;
const { browser, page, errors } = await open({ patience: 120_000 });
const { button, tab, panel, mode } = controls(page);

const chart = panel("Chart");
const part = (name) => chart.getByRole("button", { name });
const activeLine = (words) => page.locator(".cm-activeLine", { hasText: words }).waitFor();

async function set(operand, value) {
  await tab("Watch");
  if ((await page.getByLabel(`New value of ${operand}`, { exact: true }).count()) === 0) {
    await page.getByLabel("Operand or symbol").fill(operand);
    await page.keyboard.press("Enter");
  }
  await page.getByLabel(`New value of ${operand}`, { exact: true }).fill(value);
  await page.getByRole("button", { name: `Set ${operand}`, exact: true }).click();
  await tab("Chart");
}

await page.goto(`${given.replace(/\?.*/, "")}#example=mixing-sfc`);
await page.getByRole("textbox", { name: "mixing.sfc" }).waitFor();
await tab("Chart");
await part(/^initial step Wait, N Ready$/).waitFor();
assert.equal(await chart.getByRole("group", { name: /^chart / }).count(), 2, "Stir, too");
await part(/^step Heat, N Heater, D T#4s Slow$/).waitFor();

// F12 leads from a step or a transition to its line; the cursor marks what it is in; arrows go along
// the lines.
await part(/^step FillB/).click();
await page.keyboard.press("F12");
await activeLine(/^STEP FillB/);
await part(/^transition Together: Together: TRUE/).click();
await page.keyboard.press("F12");
await activeLine(/^TRANSITION Together/);
await chart.locator(".current", { hasText: "Together" }).waitFor();
await part(/^step FillB/).click();
await page.keyboard.press("ArrowDown");
await page.keyboard.press("ArrowDown");
assert.match(await page.evaluate(() => document.activeElement.getAttribute("aria-label")), /FullB/);

// Larger, and as large as fits.
const width = () =>
  chart.locator(".sheets svg").evaluate((svg) => svg.getBoundingClientRect().width);
const before = await width();
await button("Larger").click();
assert((await width()) > before);
await button("Fit").click();
const room = await chart.locator(".sheets").evaluate((place) => place.clientWidth);
assert((await width()) <= room + 1, "all of it can be seen");

for (const target of ["Simulator", "Virtual Uno"]) {
  await page.getByRole("combobox", { name: "Target" }).selectOption({ label: target });
  await button("Run").click();
  await mode("RUN");
  await part(/^initial step Wait, active/).waitFor();
  await part(/^step FillA, not active/).waitFor();
  await part(/^transition Go: Go: Start, enabled, waits for: Start$/).waitFor();
  // All three branches begin.
  await set("Start", "1");
  for (const step of ["FillA", "FillB", "Heat"])
    await part(new RegExp(`^step ${step}, active`)).waitFor();
  await part(/^initial step Wait, not active/).waitFor();
  assert.equal(
    await part(/, active/).count(),
    3 + (await part(/^(initial )?step (Left|Right), active/).count()),
  );
  await set("LevelA", "1");
  await part(/^step FullA, active/).waitFor();
  await part(/^step FillA, not active/).waitFor();
  // The transition that joins them is not enabled before the last one is there.
  await part(/^transition Together: Together: TRUE$/).waitFor();
  // Mixing: the chart of the stirrer runs.
  await set("LevelB", "1");
  await set("Warm", "1");
  await part(/^step Drain, active/).waitFor();
  await set("Start", "0");
  await button("Stop").click();
  await mode("STOP");
  await button("Reset").click();
  await button("Stop").click();
  await mode("STOP");
  console.log(`a chart: its steps on ${target}`);
}

// What the text says is drawn; what is none, is said.
await page.getByRole("textbox", { name: "mixing.sfc" }).click();
await page.keyboard.press("Control+End");
await page.keyboard.insertText("\nSTEP Later: END_STEP\n");
await part(/^step Later/).waitFor();
await page.getByRole("button", { name: "mixing.scn", exact: true }).click();
await chart.getByText(/where the editor has one with charts/).waitFor();
assert.deepEqual(errors, []);
await browser.close();
console.log("a chart: drawn, followed, and read");

// What somebody does in the first minutes, in a real Chromium, on the real core: an example, a
// mistake and its quick fix, the simulator with its plant, a force, a plot, the same figures as
// awl-sim. `node test/page.mjs ADDRESS FIGURES.csv`; the figures are what awl-sim writes.
import { readFile } from "node:fs/promises";
import assert from "node:assert/strict";
import { controls, open } from "./browser.mjs";

const [, , address, figures] = process.argv;
const { browser, page, errors } = await open();

const { button, tab, panel, mode } = controls(page);

const SIGNALS = ["Push", "Height", "Raise", "Lower"];

/** Chooses the signals in a panel. */
async function choose(name) {
  for (const signal of SIGNALS) {
    await panel(name).getByLabel("Signal", { exact: true }).fill(signal);
    await page.keyboard.press("Enter");
  }
}

/** Has the oscilloscope plot them. */
async function plot() {
  await choose("Oscilloscope");
  await panel("Oscilloscope")
    .locator(".uplot")
    .nth(SIGNALS.length - 1)
    .waitFor();
}

/** Puts the cursor at the end of the text, and writes. */
async function write(text) {
  await page.getByRole("textbox", { name: "station1.awl" }).click();
  await page.keyboard.press("Control+End");
  await page.keyboard.type(text);
}

await page.goto(`${address}#example=station1`);
await page.getByRole("textbox", { name: "station1.awl" }).waitFor();

// A mistake is shown with its code, and its quick fix mends it.
await write("\nLD IO.0\n= M31.0\n");
await tab("Problems");
await panel("Problems")
  .getByText(/E\d{4}/)
  .first()
  .waitFor();
await panel("Problems").getByRole("button", { name: /I0\.0/ }).last().click();
await panel("Problems")
  .getByText(/E\d{4}/)
  .first()
  .waitFor({ state: "detached" });

// The station sorts its six pieces.
await button("Run").click();
await mode("RUN");
await page.getByRole("combobox", { name: "Speed" }).selectOption("0");
await tab("Plant");
await panel("Plant").getByText("good: 3").waitFor();
await panel("Plant").getByText("rejected: 3").waitFor();
await page.getByRole("combobox", { name: "Speed" }).selectOption("1");

// Values beside names, and a force.
await tab("Watch");
await page.getByLabel("Operand or symbol").fill("Ready");
await page.keyboard.press("Enter");
await panel("Watch").getByRole("cell", { name: "0", exact: true }).first().waitFor();
await page.getByLabel("New value of Ready").fill("1");
await page.getByRole("button", { name: "Force Ready" }).click();
await panel("Watch").getByRole("cell", { name: "1", exact: true }).first().waitFor();
await page.getByRole("button", { name: "Release all" }).click();
await panel("Watch").getByRole("cell", { name: "0", exact: true }).first().waitFor();

// Four signals are plotted, one below the other.
await tab("Oscilloscope");
await plot();
assert.equal(await panel("Oscilloscope").locator(".uplot").count(), SIGNALS.length);
for (const signal of SIGNALS)
  await panel("Oscilloscope")
    .getByRole("button", { name: `Take ${signal} out`, exact: true })
    .click();

// The network with the cursor as a ladder: contacts are open or closed, a click leads to the line.
await page
  .getByRole("button", { name: /NETWORK 4/ })
  .first()
  .click();
await tab("Ladder");
const ladder = panel("Ladder");
await ladder.getByRole("heading", { name: /NETWORK 4/ }).waitFor();
const element = (name) => ladder.getByRole("button", { name });
await element(/^contact HasPiece M0\.0, (open|closed)$/).waitFor();
await element(/^inverted contact Measured M0\.1, (open|closed)$/).waitFor();
await element(/^box TON Settle T101, PT = 5, with(out)? power$/).waitFor();
await ladder.locator(".rail.on").first().waitFor({ state: "attached" });
await element(/^contact AtTop I0\.2/).click();
await page.locator(".cm-activeLine", { hasText: /^A\s+AtTop/ }).waitFor();
await element(/^coil S Measure Q0\.3/).focus();
await page.keyboard.press("Enter");
await page.getByRole("menuitem", { name: "Force Measure to 1" }).waitFor();
await page.keyboard.press("Escape");

// The same figures as awl-sim.
await tab("Capture");
await choose("Capture");
await button("Simulate").click();
const download = page.waitForEvent("download");
await button("Save CSV").click();
const csv = await readFile(await (await download).path(), "utf8");
assert.equal(csv, await readFile(figures, "utf8"), "the figures of awl-sim");

await button("Stop").click();
await mode("STOP");

// The same on the virtual Uno: the firmware in the page, behind its serial line.
await page.getByRole("combobox", { name: "Target" }).selectOption({ label: "Virtual Uno" });
await mode("OFFLINE");
await button("Run").click();
await mode("RUN");
await page.getByRole("combobox", { name: "Speed" }).selectOption("0");
await tab("Plant");
// From power on the plant is anew.
const CHIP_PATIENCE = { timeout: 300_000 };
await panel("Plant").getByText("good: 1").waitFor(CHIP_PATIENCE);
await panel("Plant").getByText("rejected: 1").waitFor(CHIP_PATIENCE);
await mode("×");
const status = await page.getByRole("status").first().innerText();
const pace = Number(/([\d.]+) × real time/.exec(status)?.[1]);
console.log(`the virtual Uno in the page: ${pace} times as fast as a real one`);
// What a busy computer of two cores leaves of it; how fast it can be lock_step.mjs asserts.
assert(pace > 0.25, status);
await page.getByRole("combobox", { name: "Speed" }).selectOption("1");

const row = (operand) => panel("Watch").getByRole("row").filter({ hasText: operand });
const watch = async (operand) => {
  await page.getByLabel("Operand or symbol").fill(operand);
  await page.keyboard.press("Enter");
};
await tab("Watch");
await watch("I0.4");
await row("I0.4").getByRole("cell", { name: "0", exact: true }).waitFor();
await page.getByLabel("New value of I0.4").fill("1");
await page.getByRole("button", { name: "Force I0.4" }).click();
await row("I0.4").getByRole("cell", { name: "1", exact: true }).waitFor();
await page.getByRole("button", { name: "Release all" }).click();
await row("I0.4").getByRole("cell", { name: "0", exact: true }).waitFor();

// A plot of what its line gives: a click puts a cursor, which has a value.
await tab("Oscilloscope");
await panel("Oscilloscope").getByLabel("Signal", { exact: true }).fill("Height");
await page.keyboard.press("Enter");
await panel("Oscilloscope").getByRole("combobox", { name: "Window" }).selectOption("1");
await page.waitForTimeout(3000);
await panel("Oscilloscope").getByRole("button", { name: "Hold", exact: true }).click();
const over = panel("Oscilloscope").locator(".u-over").first();
const { width } = await over.boundingBox();
await over.click({ position: { x: width / 2, y: 10 } });
await panel("Oscilloscope")
  .getByRole("row")
  .filter({ hasText: "Height" })
  .getByRole("cell", { name: /^\d+$/ })
  .first()
  .waitFor();

// Four signals of it are plotted and recorded; their values are in the range of those of awl-sim.
await panel("Oscilloscope").getByRole("button", { name: "Hold", exact: true }).click();
await plot();
await tab("Capture");
await panel("Capture").getByLabel("Seconds", { exact: true }).fill("4");
await button("Record").click();
await panel("Capture").getByText("s of the target recorded").waitFor(CHIP_PATIENCE);
const recorded = page.waitForEvent("download");
await button("Save CSV").click();
const table = (text) =>
  text
    .trim()
    .split("\n")
    .map((row) => row.split(","));
const [head, ...rows] = table(await readFile(await (await recorded).path(), "utf8"));
const [wanted, ...simulated] = table(csv);
assert.deepEqual(head, wanted);
assert(rows.length > 50, `${rows.length} rows`);
assert(Number(rows.at(-1)[0]) > 3500, `${rows.at(-1)}`);
for (const [index, row] of rows.entries()) {
  if (index > 0) assert(Number(row[0]) > Number(rows[index - 1][0]), `${row}`);
  assert(Number(row[1]) > Number(rows[index - 1]?.[1] ?? 0), `${row}`);
}
for (const column of [2, 3, 4, 5]) {
  const known = simulated.map((row) => Number(row[column]));
  const [least, most] = known.reduce(([a, b], one) => [Math.min(a, one), Math.max(b, one)], [0, 0]);
  for (const row of rows) {
    const value = Number(row[column]);
    assert(Number.isInteger(value) && value >= least && value <= most, `${head[column]}: ${row}`);
  }
}

// A board's switch, in STOP and single scans.
await button("Stop").click();
await mode("STOP");
await button("Single scan").click();
await mode("STOP");
await button("Reset").click();
await mode("RUN");
await button("Pause").click();
await mode("PAUSE");
await button("Run").click();
await mode("RUN");
await button("Stop").click();
await mode("STOP");
assert.deepEqual(errors, []);
await browser.close();
console.log("the page does what it should");

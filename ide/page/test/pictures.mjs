// How the page looks, in both themes and two widths, in a real Chromium on the real core; axe-core
// looks at each picture, too. `node test/pictures.mjs ADDRESS OUT`: the folder that they are put in;
// docs/ide has those that docs/ide.md shows.
import assert from "node:assert/strict";
import { mkdir, readFile } from "node:fs/promises";
import { join } from "node:path";
import { open } from "./browser.mjs";

const [, , address, out] = process.argv;
const AXE = await readFile(new URL("../node_modules/axe-core/axe.min.js", import.meta.url), "utf8");
const WIDTHS = { 1024: 900, 390: 844 };
/** Panels, and what is done in each before it is looked at. */
const PANELS = {
  Plant: (page) => page.waitForTimeout(500),
  Ladder: toNetwork4,
  Oscilloscope: (page) => signals(page, "Oscilloscope", ["Ready", "Height"]),
  Watch: async (page) => {
    for (const operand of ["Ready", "Height", "MW3"]) {
      await page.getByLabel("Operand or symbol").fill(operand);
      await page.keyboard.press("Enter");
    }
  },
  Capture: async (page) => {
    await signals(page, "Capture", ["Push", "Height"]);
    await page.getByRole("button", { name: "Simulate", exact: true }).click();
    await page
      .getByText(/s simulated/)
      .first()
      .waitFor();
    await page.getByText("Step response", { exact: true }).click();
    await page.getByRole("table", { name: "Step response" }).scrollIntoViewIfNeeded();
  },
  Tests: async (page) => {
    await page.getByRole("button", { name: "Test all" }).click();
    await page
      .getByText(/met, 0 failed/)
      .first()
      .waitFor();
  },
  Problems: async (page) => {
    await page.getByRole("textbox", { name: "station1.awl" }).focus();
    await page.keyboard.press("Control+End");
    await page.keyboard.type("\nNETWORK 12\nLD IO.0\nTON T5, 20\n");
    await page
      .getByText(/E\d{4}/)
      .first()
      .waitFor();
  },
};

/** The cursor into the largest network. */
async function toNetwork4(page) {
  await page.getByRole("textbox", { name: "station1.awl" }).focus();
  await page.keyboard.press("Control+Home");
  for (let line = 1; line < 64; line += 1) await page.keyboard.press("ArrowDown");
  const ladder = page.getByRole("tabpanel", { name: "Ladder" });
  await ladder.getByRole("heading", { name: /NETWORK 4/ }).waitFor();
  await page.waitForTimeout(700);
}

async function signals(page, name, signals) {
  const panel = page.getByRole("tabpanel", { name });
  for (const signal of signals) {
    await panel.getByLabel("Signal", { exact: true }).fill(signal);
    await page.keyboard.press("Enter");
  }
  await page.waitForTimeout(1500);
}

const { browser, errors } = await open();
const breaches = [];
await mkdir(out, { recursive: true });

async function look(page, name) {
  await page.screenshot({ path: join(out, `${name}.png`), animations: "disabled", scale: "css" });
  await page.evaluate(AXE);
  const { violations } = await page.evaluate(() => window.axe.run());
  for (const { id, nodes } of violations)
    breaches.push(...nodes.map(({ html }) => `${name}: ${id}: ${html.slice(0, 120)}`));
}

/** Opens an example and runs it. */
async function run(page, example) {
  await page.goto("about:blank");
  await page.goto(`${address.replace(/\?.*/, "")}#example=${example}`);
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await page.getByRole("status").first().filter({ hasText: "RUN" }).waitFor();
}

for (const colorScheme of ["light", "dark"])
  for (const [width, height] of Object.entries(WIDTHS)) {
    const viewport = { width: Number(width), height };
    const context = await browser.newContext({ viewport, colorScheme });
    const page = await context.newPage();
    page.setDefaultTimeout(60_000);
    page.on("pageerror", (error) => errors.push(error.message));
    await run(page, "station1");
    await page.waitForTimeout(4000);
    for (const [panel, prepare] of Object.entries(PANELS)) {
      await page.getByRole("tab", { name: panel, exact: true }).click();
      await prepare(page);
      await look(page, `${panel.toLowerCase()}-${colorScheme}-${width}`);
    }
    await page.getByRole("button", { name: "Help" }).click();
    await look(page, `help-${colorScheme}-${width}`);
    await run(page, "station1-st");
    await page.getByRole("textbox", { name: "station1.st" }).focus();
    for (let line = 1; line < 70; line += 1) await page.keyboard.press("ArrowDown");
    await page.waitForTimeout(4000);
    await look(page, `structured-${colorScheme}-${width}`);
    await run(page, "control_loop-fbd");
    await page.getByRole("tab", { name: "Diagram", exact: true }).click();
    await page.getByRole("button", { name: /^2: Loop/ }).click();
    await page.getByRole("slider", { name: "Slider for SP" }).fill("0.8");
    await page.waitForTimeout(4000);
    await look(page, `diagram-${colorScheme}-${width}`);
    await run(page, "traffic_light-sfc");
    await page.getByRole("tab", { name: "Chart", exact: true }).click();
    await page.waitForTimeout(4000);
    await look(page, `chart-${colorScheme}-${width}`);
    await page.getByRole("button", { name: "Follow", exact: true }).click();
    await page.getByRole("menuitemradio", { name: /^Steps over time/ }).click();
    await page.waitForTimeout(500);
    await look(page, `steps-${colorScheme}-${width}`);
    // Nothing is wider than the window.
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert(wide <= 0, `${wide} pixels too wide at ${width}`);
    await context.close();
  }
assert.deepEqual(breaches, []);
assert.deepEqual(errors, []);
await browser.close();
console.log(`pictures in ${out}; axe-core finds nothing`);

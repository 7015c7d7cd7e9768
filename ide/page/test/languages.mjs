// Programs in other languages than AWL, in a real Chromium on the real core: Structured Text with
// values and what has become of its statements, on the simulator and on the virtual Uno; charts and
// function blocks of IEC 61499 as files of a project. `node test/languages.mjs ADDRESS`.
import assert from "node:assert/strict";
import { controls, open } from "./browser.mjs";

const [, , given] = process.argv;
const address = given.replace(/\?.*/, "");
const { browser, page, errors } = await open({ patience: 120_000 });
const { button, tab, panel, mode } = controls(page);
const text = (name) => page.getByRole("textbox", { name });

async function example(name) {
  await page.goto("about:blank");
  await page.goto(`${address}#example=${name}`);
}

/** The line with this text, and the mark and the values beside it. */
const line = (words) => page.locator(".cm-line", { hasText: words });
const values = (words) => line(words).first().locator(".live .value");
const mark = (words) =>
  page.evaluate((words) => {
    const lines = [...document.querySelectorAll(".cm-line")];
    const top = (element) => Math.round(element.getBoundingClientRect().top);
    const at = lines.find((line) => line.textContent.includes(words));
    const flows = [...document.querySelectorAll(".flow")];
    const flow = at && flows.find((flow) => Math.abs(top(flow.parentElement) - top(at)) < 4);
    return flow ? flow.className.replace("flow ", "") : "none";
  }, words);

/** How far the text is scrolled. */
const scrolled = () => page.evaluate(() => document.querySelector(".cm-scroller").scrollTop);

/** Waits until a line has had all of these marks, whatever the order. */
async function marks(words, wanted) {
  const seen = new Set();
  for (let tries = 0; tries < 600 && wanted.some((one) => !seen.has(one)); tries += 1) {
    seen.add(await mark(words));
    await page.waitForTimeout(50);
  }
  for (const one of wanted) assert(seen.has(one), `${words}: ${[...seen]}`);
}

/** Runs the program on both targets, and looks at it on each. */
async function onBoth(look) {
  for (const target of ["Simulator", "Virtual Uno"]) {
    await page.getByRole("combobox", { name: "Target" }).selectOption({ label: target });
    await button("Run").click();
    await mode("RUN");
    await look(target);
    await button("Stop").click();
    await mode("STOP");
  }
}

/** Waits until an operand of the watch table has a value. */
async function watched(operand, value) {
  const row = panel("Watch").getByRole("row").filter({ hasText: operand }).first();
  await row.getByRole("cell", { name: value, exact: true }).waitFor();
}

async function watch(operand) {
  await tab("Watch");
  await page.getByLabel("Operand or symbol").fill(operand);
  await page.keyboard.press("Enter");
}

/** The scenario of the example is green. */
async function passes() {
  await tab("Tests");
  await button("Test all").click();
  await panel("Tests")
    .getByText(/met, 0 failed/)
    .first()
    .waitFor();
}

// The station in Structured Text sorts; beside its lines is what happens in them.
await example("station1-st");
await text("station1.st").waitFor();
const arrives = "IF PieceThere AND AtBottom";
await onBoth(async (target) => {
  await page.getByRole("button", { name: /Main/ }).first().click();
  await values(arrives).first().waitFor();
  // On a slow computer they are shown before they are known.
  await values(arrives).filter({ hasText: /\?$/ }).first().waitFor({ state: "detached" });
  assert.deepEqual(
    (await values(arrives).allInnerTexts()).map((value) => value.replace(/ [01]$/, "")),
    ["PieceThere", "AtBottom", "Reject", "HasPiece"],
    target,
  );
  assert.equal(await values("PROGRAM Main").count(), 0);
  await marks("Measure := TRUE;", ["skipped", "on"]);
  await marks("IF HasPiece AND AtTop AND NOT Measured", ["off", "on"]);
  // A click forces, and the text stays where it was scrolled to.
  await values("Good := Measured").first().click();
  const top = await scrolled();
  await page.getByRole("menuitem", { name: "Force Good to 1", exact: true }).click();
  await page.locator(".live .value.forced").first().waitFor();
  assert.equal(await scrolled(), top);
});
console.log("Structured Text: values, and what has become of its statements");

// A chart: its outline, its tests, both targets, a mistake.
await example("mixing-sfc");
await text("mixing.sfc").waitFor();
await page.getByRole("button", { name: /^FillA STEP/ }).waitFor();
assert.equal(await line("STEP FillA").first().locator(".tok-keyword").first().innerText(), "STEP");
await passes();
await onBoth(async () => {
  await watch("mixing.Wait");
  await watched("mixing.Wait", "1");
});
await text("mixing.sfc").click();
await page.keyboard.press("Control+End");
await page.keyboard.type("\nTRANSITION FROM Nowhere TO Wait := TRUE; END_TRANSITION\n");
await tab("Problems");
await panel("Problems")
  .getByText(/E03\d\d/)
  .first()
  .waitFor();
console.log("a chart: outline, tests, simulator and virtual Uno, a mistake");

// A function block: the same; an event is set by hand.
await example("tank-fbt");
await text("tank.fbt").waitFor();
await page.getByRole("button", { name: /FUNCTION_BLOCK/ }).waitFor();
await page.getByRole("button", { name: /^Control event/ }).waitFor();
assert((await page.locator(".cm-line .tok-typeName", { hasText: "Name" }).count()) > 0, "colours");
await passes();
await onBoth(async () => {
  await watch("Bomba.count");
  await watch("Control");
  await page.getByLabel("New value of Control").fill("1");
  await page.getByRole("button", { name: "Set Control" }).click();
  await watched("Bomba.count", "1");
});
console.log("a function block: outline, tests, simulator and virtual Uno");

// A new chart is kept over a reload.
await example("motor");
await text("motor.awl").waitFor();
await button("New file").click();
await page.getByLabel("Name, with its ending").fill("blink.sfc");
await page.keyboard.press("Enter");
await text("blink.sfc").click();
await page.keyboard.insertText(
  "VAR_GLOBAL Lamp AT %Q0.0 : BOOL; END_VAR\nPROGRAM Blink\nINITIAL_STEP Off: END_STEP\n" +
    "STEP On: Lamp; END_STEP\nTRANSITION FROM Off TO On := Off.T >= T#200ms; END_TRANSITION\n" +
    "TRANSITION FROM On TO Off := On.T >= T#200ms; END_TRANSITION\nEND_PROGRAM\n",
);
await page.waitForTimeout(2000);
await page.reload();
await page.getByRole("button", { name: "blink.sfc", exact: true }).click();
await text("blink.sfc").filter({ hasText: "PROGRAM Blink" }).waitFor();
assert.deepEqual(errors, []);
await browser.close();
console.log("a new chart is kept");

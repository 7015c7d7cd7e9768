// Charts that run, in a real Chromium on the real core: conditions and what they wait for, times of
// steps, steps that are set by hand, single scans, the moments that were, the diagram of steps over
// time, macro-steps that are folded, a text that was changed meanwhile.
// `node test/chart_live.mjs ADDRESS [FOLDER]`: a folder for pictures.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { controls, open, watched } from "./browser.mjs";
import { file, load } from "./drawing_page.mjs";
import { loadSource } from "./load.mjs";

const [, , address, pictures] = process.argv;
const { browser, page, errors } = await open({ patience: 60_000 });
const { button, panel, mode } = controls(page);
const chart = panel("Chart");
const key = (name) => page.keyboard.press(name);
const part = (name) => chart.getByRole("button", { name });
const step = (name, more = "") => part(new RegExp(`^(initial )?step ${name}${more}(,|$)`));
const transition = (title, more) => part(new RegExp(`^transition ${title}: .*${more}$`));
const note = (words) => chart.locator(".sheets .note-live", { hasText: words });
const slider = chart.getByRole("slider", { name: "Shown moment" });
const told = () => chart.locator(".moments output").innerText();
/** So many charts are drawn. */
const shown = (count) =>
  page.waitForFunction(
    (count) =>
      document.querySelectorAll(".sheets [aria-label^='chart ']:not([hidden])").length === count,
    count,
  );
const picture = async (name) => {
  if (!pictures) return;
  for (const theme of ["light", "dark"]) {
    await page.evaluate((theme) => (document.documentElement.dataset.theme = theme), theme);
    await page.waitForTimeout(200);
    await page.screenshot({ path: join(pictures, `chart-live-${name}-${theme}.png`) });
  }
  await page.evaluate(() => (document.documentElement.dataset.theme = "light"));
};
const target = (name) =>
  page.getByRole("combobox", { name: "Target" }).selectOption({ label: name });

// What is kept of moments: so many, with gaps, from one start on.
const { Trail } = await loadSource("src/chart/trail.ts");
const trail = new Trail();
const moment = (timeMs, active) => {
  const steps = [[active === 0, active === 1]];
  return { timeMs, scan: timeMs, steps, values: [timeMs] };
};
for (let time = 0; time < 50_000; time += 1) {
  trail.add([], moment(time, time % 2), false);
  if (time === 49_000) trail.goTo(trail.moments.length - 1);
}
assert(trail.moments.length <= 20_000 && trail.moments.length >= 17_000, `${trail.moments.length}`);
assert.equal(trail.shown.timeMs, 49_000, "what is shown stays while others go");
trail.go(-1);
assert.equal(trail.shown.timeMs, 48_999);
assert.deepEqual(trail.lasting(0, 1), { ms: 0, isLeast: false });
trail.goTo(-1);
trail.add([], moment(60_000, 1), false);
assert.equal(trail.moments.at(-1).timeMs, 49_999, "the same situation is no other moment");
assert.deepEqual(trail.lasting(0, 1), { ms: 10_001, isLeast: false });
trail.add([], moment(60_001, 0), true);
assert.equal(trail.losses, 1);
assert.deepEqual(trail.moments.at(-2).steps, [[null, null]], "a gap");
trail.add([], moment(5, 0), false);
assert.deepEqual([trail.moments.length, trail.losses], [1, 0], "another start");
assert.deepEqual(trail.lasting(0, 0), { ms: 0, isLeast: true });
const large = Array.from({ length: 2_500 }, () => false);
for (let time = 0; time < 2_000; time += 1)
  trail.add(
    [],
    { timeMs: time, scan: 0, steps: [large.with(0, time % 2 === 0)], values: [] },
    false,
  );
assert(trail.moments.length <= 800, "fewer of a large chart");
console.log("moments: as many as there is room for");

const TANK = `PROGRAM Tank
VAR
    Start AT %M0.0 : BOOL;
    Stop AT %M0.1 : BOOL;
    Level AT %MW2 : INT;
END_VAR
INITIAL_STEP Wait:
END_STEP
STEP Fill:
END_STEP
STEP Drain:
END_STEP
TRANSITION FROM Wait TO Fill := Start AND NOT Stop AND Level < 3;
END_TRANSITION
TRANSITION FROM Fill TO Drain := Level >= 9 OR Fill.T >= T#1h;
END_TRANSITION
TRANSITION FROM Drain TO Wait := Drain.T >= T#300ms;
END_TRANSITION
END_PROGRAM
`;

/** Sets an operand in the watch table. */
async function set(operand, value) {
  await page.getByRole("tab", { name: "Watch", exact: true }).click();
  if ((await page.getByLabel(`New value of ${operand}`, { exact: true }).count()) === 0) {
    await page.getByLabel("Operand or symbol").fill(operand);
    await key("Enter");
  }
  await page.getByLabel(`New value of ${operand}`, { exact: true }).fill(value);
  await button(`Set ${operand}`).click();
  await page.getByRole("tab", { name: "Chart", exact: true }).click();
}

// What enabled transitions wait for, with the values in their conditions; times of active steps.
await load(page, address, file("tank.sfc", TANK));
for (const name of ["Simulator", "Virtual Uno"]) {
  await target(name);
  await button("Run").click();
  await mode("RUN");
  await step("Wait", ", active").waitFor();
  await transition("Wait_to_Fill", "enabled, waits for: Start").waitFor();
  await note(/^waits for: Start/)
    .filter({ hasText: "Level = 0" })
    .waitFor();
  await note(/^(≥ )?\d+\.\d+ s$/).waitFor();
  await set("MW2", "5");
  await transition("Wait_to_Fill", "waits for: Start AND Level < 3").waitFor();
  await set("MW2", "1");
  await set("M0.0", "1");
  await step("Fill", ", active").waitFor();
  await transition("Fill_to_Drain", "waits for: Level >= 9 OR Fill.T >= T#1h").waitFor();
  if (name === "Simulator") await transition("Wait_to_Fill", "just crossed").waitFor();
  await note(/Level = 1 · Fill.T = \d+\.\d+ s/).waitFor();
  await picture(`condition-${name.replace(" ", "-")}`);
  await set("M0.0", "0");
  await set("MW2", "9");
  await step("Wait", ", active").waitFor();
  await set("MW2", "1");
  await chart.getByRole("button", { name: "Moment back" }).click();
  assert.match(await told(), /moment \d+ of \d+/);
  await chart.getByRole("button", { name: "Back to now" }).click();
  console.log(`conditions, values, times and moments on ${name}`);
}

// The moments that were: back and forth by keys, buttons and the slider.
await target("Simulator");
await button("Run").click();
await mode("RUN");
await step("Wait", ", active").waitFor();
await set("MW2", "1");
await set("M0.0", "1");
await step("Fill", ", active").waitFor();
await set("M0.0", "0");
await set("MW2", "9");
await step("Wait", ", active").waitFor();
assert.match(await told(), /^now, .*; moments: \d+/);
await step("Wait").click();
await key(",");
await step("Drain", ", active").waitFor();
assert.match(await told(), /moment \d+ of \d+/);
await transition("Fill_to_Drain", "just crossed").waitFor();
await picture("moment");
await chart.getByRole("button", { name: "Moment back" }).click();
await step("Fill", ", active").waitFor();
const [, filling] = /^(\S+) s/.exec(await told());
await slider.focus();
await key("ArrowRight");
await step("Drain", ", active").waitFor();
const [, draining] = /^(\S+) s/.exec(await told());
assert(Number(draining) > Number(filling), `${filling} to ${draining}`);
await step("Drain").click();
await key(".");
await step("Wait", ", active").waitFor();
await key("l");
await page.waitForFunction(() => /^now/.test(document.querySelector(".moments output").value));
console.log("moments back and forth");

// A step that is set by hand while it runs, and while it is paused; scan by scan.
await step("Drain").click();
await key("x");
await step("Drain", ", active").waitFor();
await step("Drain", ", not active").waitFor();
await button("Pause").click();
await mode("PAUSE");
await step("Fill").click();
await key("x");
await step("Fill", ", active").waitFor();
await step("Wait", ", active").waitFor();
await chart.getByRole("button", { name: "One scan", exact: true }).click();
await step("Drain", ", active").waitFor();
await transition("Fill_to_Drain", "just crossed").waitFor();
await step("Drain").click({ button: "right" });
await page.getByRole("menuitem", { name: /^Activate step/ }).click();
await step("Drain", ", not active").waitFor();
await step("Fill").click();
await key("x");
await step("Fill", ", active").waitFor();
const scansOf = async () => Number(/scan (\d+)/.exec(await told())[1]);
const scans = await scansOf();
await key("F10");
await step("Drain", ", active").waitFor();
assert.equal(await scansOf(), scans + 1);
console.log("steps set by hand, scan by scan");

// Steps over time: a row for each, a click goes there, both files.
await step("Wait").click();
await key("g");
const diagram = chart.getByRole("img", { name: /^which steps were active/ });
await diagram.waitFor();
for (const name of ["Wait", "Fill", "Drain"])
  await diagram.locator(".row-name", { hasText: name }).waitFor();
await page.waitForFunction(() =>
  [...document.querySelectorAll(".plot .bar-on")].every((bar) => bar.getAttribute("d") !== ""),
);
await picture("times");
const { x, y, width, height } = await diagram.boundingBox();
await page.mouse.click(x + width * 0.6, y + height / 3);
await page.waitForFunction(() => /moment/.test(document.querySelector(".moments output").value));
await diagram.locator(".cursor").waitFor({ state: "attached" });
const shownAt = await told();
await chart.getByRole("group", { name: "Steps over time" }).focus();
await key("ArrowLeft");
assert.notEqual(await told(), shownAt);
for (const [name, begin] of [
  ["Diagram as SVG", "<svg"],
  ["Diagram as PNG", "\x89PNG"],
]) {
  const download = page.waitForEvent("download");
  await chart.getByRole("button", { name, exact: true }).click();
  const saved = await download;
  assert.match(saved.suggestedFilename(), /^tank-steps\.(svg|png)$/);
  const bytes = await readFile(await saved.path());
  assert(bytes.toString("latin1").startsWith(begin), name);
  if (begin === "<svg") assert.match(bytes.toString(), />Drain<\/text>/);
}
await key("g");
console.log("steps over time");

// A text that is changed while the old program runs: that is said, and mended by a button.
await chart.getByRole("button", { name: "Back to now" }).click();
await button("Pause").click();
await mode("RUN");
await page.locator(".cm-line", { hasText: "INITIAL_STEP Wait" }).click();
await key("Home");
await page.keyboard.insertText("STEP Later:\nEND_STEP\n");
await chart.getByText("The target has another program than this text").waitFor();
await step("Later").waitFor();
await picture("other");
await chart.getByRole("button", { name: "Load anew" }).click();
await step("Wait", ", active").waitFor();
await chart.getByText("The target has another program").waitFor({ state: "hidden" });
console.log("another program in the target");

// A macro-step folded and unfolded: its chart is left out, the step stays active with it.
await page.goto("about:blank");
await page.goto(`${address.replace(/\?.*/, "")}#example=station1-grafcet`);
await page.getByRole("textbox", { name: /\.sfc$/ }).waitFor();
await page.getByRole("tab", { name: "Chart", exact: true }).click();
const sheets = chart.getByRole("group", { name: /^chart / });
await step("Gauge").waitFor();
const all = await sheets.count();
await picture("unfolded");
await step("Gauge").click();
await key("m");
await shown(all - 1);
await step("Gauge", ", folded").waitFor();
await picture("folded");
await chart.getByRole("tab", { name: "Station.Measuring" }).click();
await sheets.first().waitFor();
await chart.getByRole("tab", { name: "All charts" }).click();
await shown(all);
console.log("a macro-step folded and unfolded");

// The same with fingers on a telephone.
const viewport = { width: 390, height: 844 };
const context = await browser.newContext({ viewport, hasTouch: true, isMobile: true });
const phone = watched(await context.newPage(), errors);
await load(phone, address, file("tank.sfc", TANK));
const there = phone.getByRole("tabpanel", { name: "Chart", exact: true });
const tap = (name) => there.getByRole("button", { name }).tap();
await phone.getByRole("button", { name: "Run", exact: true }).tap();
await there.getByRole("button", { name: /^initial step Wait, active/ }).waitFor();
await there.locator(".stage").scrollIntoViewIfNeeded();
await tap(/^step Drain/);
await tap("Follow");
await phone.getByRole("menuitem", { name: /^Activate step/ }).tap();
await there.getByRole("button", { name: /^step Drain, active/ }).waitFor();
await there.getByRole("button", { name: /^step Drain, not active/ }).waitFor();
await tap("Moment back");
await there.getByRole("button", { name: /^step Drain, active/ }).waitFor();
await tap("Follow");
await phone.getByRole("menuitemradio", { name: /^Steps over time/ }).tap();
const rows = there.getByRole("img", { name: /^which steps were active/ });
await rows.scrollIntoViewIfNeeded();
await rows.tap({ position: { x: 60, y: 10 } });
await there.getByRole("button", { name: /^initial step Wait, active/ }).waitFor();
if (pictures) await phone.screenshot({ path: join(pictures, "chart-live-phone.png") });
await tap("Back to now");
const areLarge = await there
  .locator(".moments button")
  .evaluateAll((buttons) => buttons.every((one) => one.getBoundingClientRect().height >= 44));
assert(areLarge, "buttons are as large as fingers");
console.log("charts that run under a finger");

assert.deepEqual(errors, []);
await browser.close();
console.log("charts that run: followed, set, recorded");

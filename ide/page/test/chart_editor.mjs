// Charts drawn in the page, in a real Chromium on the real core: twenty steps from nothing with keys
// alone, and with the mouse alone; what is active on the simulator and on the virtual Uno is what the
// core tells; undo and redo, refusals, copies, drags, fingers, pictures, and two thousand steps.
// `node test/chart_editor.mjs ADDRESS`.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { controls, open, watched } from "./browser.mjs";
import { chain, file, listen, load as loadAt, longTasks, middle } from "./drawing_page.mjs";

/** Steps of a large chart, and how often it is changed. */
const LARGE = 2000;
const EDITS = 8;

const [, , given] = process.argv;
const { browser, page, errors } = await open({ patience: 30_000 });

const load = (page, ...files) => loadAt(page, given, ...files);
const { button, tab, panel, mode } = controls(page);
const chart = panel("Chart");
const key = (name) => page.keyboard.press(name);
const write = async (words) => (await page.keyboard.type(words), await key("Enter"));
const part = (name) => chart.getByRole("button", { name });
const step = (name) => part(new RegExp(`^(initial )?step ${name}(,|$)`));
const transition = (title) => part(new RegExp(`^transition ${title}:`));
const focused = (name) =>
  page.waitForFunction(
    (name) => document.activeElement?.getAttribute("aria-label")?.match(name),
    new RegExp(name),
  );
const line = (words) => page.locator(".cm-line", { hasText: words });
const text = (name = "press.sfc") => page.evaluate((name) => globalThis.texts[name], name);
const isText = (words, name = "press.sfc") =>
  page.waitForFunction(([words, name]) => globalThis.texts[name] === words, [words, name]);
const field = (name) => chart.getByRole("textbox", { name });
const refusal = chart.locator(".refusal");

const isIn = (words, name = "mouse.sfc") =>
  page.waitForFunction(([words, name]) => globalThis.texts[name].includes(words), [words, name]);

/** Waits until these steps are active in the drawing, and in what the core tells. */
async function active(...expected) {
  const names = [...(await text()).matchAll(/STEP (\w+):/g)].map(([, name]) => name);
  const read = ([names, expected]) => {
    const told = names.filter((_, at) => globalThis.told[0]?.[at]);
    const nodes = [...document.querySelectorAll(".sheets [role=button]")];
    const label = (node) => node.getAttribute("aria-label");
    const drawn = nodes.flatMap((node) => /step (\w+), active/.exec(label(node))?.[1] ?? []);
    const isIt = (names) => names.toSorted().join() === expected.toSorted().join();
    return isIt(told) && isIt(drawn);
  };
  await page.waitForFunction(read, [names, expected]);
}

async function set(operand, value) {
  await tab("Watch");
  const field = page.getByLabel(`New value of ${operand}`, { exact: true });
  if ((await field.count()) === 0) {
    await page.getByLabel("Operand or symbol").fill(operand);
    await key("Enter");
  }
  await field.fill(value);
  await page.getByRole("button", { name: `Set ${operand}`, exact: true }).click();
  await tab("Chart");
}

/** Selects what these words are found at. */
async function find(words, name) {
  await key("Control+f");
  await page.keyboard.type(words);
  await key("Escape");
  await focused(name);
}

/** Writes the condition of a transition. */
async function condition(title, words) {
  await find(title, `^transition ${title}`);
  await key("Enter");
  await write(words);
  await focused(`: ${words}$`);
}

async function after(...names) {
  for (const name of names) {
    await key("n");
    await focused(`^step ${name}$`);
  }
}

const name = "mouse.sfc";
/** Chooses an item of a menu. */
const choose = async (menu, item) => {
  await button(menu).click();
  await page.getByRole("menuitem", { name: item }).click();
};

/** Drags from a point of the window to another one. */
const drag = async (from, to, options = {}) => {
  await page.mouse.move(...from);
  await page.mouse.down(options);
  await page.mouse.move((from[0] + to[0]) / 2, (from[1] + to[1]) / 2);
  await page.mouse.move(...to, { steps: 3 });
  await page.mouse.up(options);
};

// With keys alone: the panel, its button, then a key for each thing.
await listen(page);
await load(page, file("press.sfc"), file("other.sfc"));
await button("First step").waitFor();
await key("Alt+8");
await key("Tab");
await key("Tab");
await key("Enter");
await focused("^initial step S1$");
await key("Enter");
await write("Wait");
await focused("^initial step Wait$");
await key("a");
await write("Ready");
await focused("^initial step Wait, N Ready$");
await after("S2", "S3", "S4", "S5", "S6", "S7", "S8");
await find("S4", "^step S4$");
await key("p");
await focused("^step S9$");
await key("F2");
await write("Heat");
await focused("^step Heat$");
await key("a");
await write("L T#2s Heater");
await focused("^step Heat, L T#2s Heater$");
// The branches are joined: Heat and S5, before S6.
await find("S5_to_S6", "^transition S5_to_S6:");
await key("Delete");
await transition("S5_to_S6").waitFor({ state: "detached" });
await find("S5", "^step S5$");
await key("Shift+ArrowRight");
await key("c");
await field(/^Connect S5, Heat to$/).waitFor();
await write("S6");
await focused("^transition .*_to_S6");
await key("ArrowDown");
await focused("^step S6$");
await key("b");
await focused("^step S10$");
await key("c");
await write("S8");
await focused("^transition S10_to_S8:");
await find("S8", "^step S8$");
await after("S11", "S12", "S13", "S14", "S15", "S16", "S17", "S18", "S19", "S20");
await key("c");
await write("Wait");
await focused("^transition S20_to_Wait:");
await condition("Wait_to_S2", "Go");
await condition("S4_to", "Split");
await condition("S5_Heat_to_S6", "Join");
await condition("S6_to_S7", "Red AND NOT Green");
await condition("S6_to_S10", "Green");
await condition("S20_to_Wait", "NOT Go");
await key("0");
assert.equal(await part(/^(initial )?step /).count(), 20);
console.log("twenty steps drawn with keys alone");

// Undo leads to the empty file, redo forward.
const whole = await text();
let changes = 0;
await find("Heat", "^step Heat");
while ((await text()) !== "") {
  const before = await text();
  await key("Control+z");
  await page.waitForFunction((before) => globalThis.texts["press.sfc"] !== before, before);
  changes += 1;
}
await button("First step").waitFor();
await page.getByRole("textbox", { name: "press.sfc" }).focus();
for (let change = 0; change < changes; change += 1) await key("Control+y");
await isText(whole);
await step("Heat").waitFor();
console.log(`${changes} changes taken back, and made again`);

// What is active is what the core tells, on the simulator and on the virtual Uno.
for (const target of ["Simulator", "Virtual Uno"]) {
  await page.getByRole("combobox", { name: "Target" }).selectOption({ label: target });
  await button("Run").click();
  await mode("RUN");
  await active("Wait");
  await set("Go", "1");
  await active("S4");
  await set("Split", "1");
  await active("S5", "Heat");
  await set("Join", "1");
  await active("S6");
  await set("Green", "1");
  await active("S20");
  await set("Go", "0");
  await active("Wait");
  for (const operand of ["Split", "Join", "Green"]) await set(operand, "0");
  await button("Stop").click();
  await mode("STOP");
  await button("Reset").click();
  await button("Stop").click();
  await mode("STOP");
  console.log(`active steps on ${target}`);
}

// With the mouse alone: buttons, menus, drags.
await load(page, file(name));
await button("First step").click();
await step("S1").waitFor();
for (let number = 2; number <= 8; number += 1) {
  await button("Step after").click();
  await focused(`^step S${number}$`);
}
await step("S4").click();
await choose("Insert", "Parallel branch");
await focused("^step S9$");
await transition("S5_to_S6").click();
await choose("Change", "Erase");
await transition("S5_to_S6").waitFor({ state: "detached" });
await step("S5").click();
await step("S9").click({ modifiers: ["Shift"] });
await step("S6").click({ modifiers: ["Shift"] });
await choose("Insert", "Connect what is selected");
await transition("S5_S9_to_S6").waitFor();
await step("S6").click();
await choose("Insert", "Alternative branch");
await focused("^step S10$");
await step("S8").scrollIntoViewIfNeeded();
await drag(await middle(chart.locator(".handle .dot")), await middle(step("S8")));
await transition("S10_to_S8").waitFor();
await step("S8").click();
for (let number = 11; number <= 20; number += 1) {
  await button("Step after").click();
  await focused(`^step S${number}$`);
}
await button("Fit").click();
await step("S1").click({ modifiers: ["Shift"] });
await choose("Insert", "Connect what is selected");
await transition("S20_to_S1").waitFor();
assert.equal(await part(/^(initial )?step /).count(), 20);

/** The steps that are active in the drawing as the core tells, other ones than these. */
async function others(before) {
  const names = [...(await text(name)).matchAll(/STEP (\w+):/g)].map(([, name]) => name);
  const read = ([names, before]) => {
    const told = names.filter((_, at) => globalThis.told[0]?.[at]);
    const labels = [...document.querySelectorAll(".sheets [role=button]")].map((node) =>
      node.getAttribute("aria-label"),
    );
    const drawn = labels.flatMap((label) => /step (\w+), active/.exec(label)?.[1] ?? []);
    const now = told.toSorted().join();
    return now !== "" && now !== before && now === drawn.toSorted().join() && now;
  };
  const handle = await page.waitForFunction(read, [names, before]);
  return handle.jsonValue();
}
await page.getByRole("combobox", { name: "Target" }).selectOption({ label: "Simulator" });
await button("Run").click();
await mode("RUN");
await button("Pause").click();
// What was told before the pause may be what the single scan leads to: the chart is a circle.
await mode("PAUSE");
let now = await others("");
const seen = new Set();
for (let scan = 0; scan < 18; scan += 1) {
  await button("Single scan").click();
  now = await others(now);
  for (const one of now.split(",")) seen.add(one);
}
assert(seen.has("S5") && seen.has("S9") && seen.has("S20"), [...seen].join());
await button("Stop").click();
await mode("STOP");
console.log("twenty steps drawn with the mouse alone, and followed scan by scan");

// What is refused says why, and nothing that was written is lost.
await step("S2").dblclick();
await write("2 words");
await refusal.filter({ hasText: /no name/ }).waitFor();
assert.equal(await field(/^Name of step S2$/).inputValue(), "2 words");
await field(/^Name of step S2$/).fill("Fill");
await key("Enter");
await step("Fill").waitFor();
await button("Insert").click();
const item = page.getByRole("menuitem", { name: "Connect what is selected" });
assert.equal(await item.getAttribute("aria-disabled"), "true");
assert.match(await item.getAttribute("title"), /two steps/);
await key("Escape");
await step("S1").click();
await key("Delete");
await page
  .getByRole("alert")
  .filter({ hasText: /initial step/ })
  .waitFor();
await page.getByRole("button", { name: "Close the message" }).click();

// A block: names are offered, its actions are changed, moved and erased.
await step("Fill").click();
await key("a");
await write("Valve");
await focused("^step Fill, N Valve$");
await key("a");
await write("D T#1s Lamp");
await focused("^step Fill, N Valve, D T#1s Lamp$");
await key("ArrowRight");
await focused("^action N Valve of Fill$");
await key("Alt+ArrowDown");
await step("Fill, D T#1s Lamp, N Valve").waitFor();
await key("Enter");
await page.keyboard.type("La");
await chart.getByRole("option", { name: "Lamp" }).waitFor();
await key("Escape");
await key("Escape");
await key("Delete");
await part(/^action/)
  .nth(1)
  .waitFor({ state: "detached" });
await focused("^(action|step)");
assert.equal(await part(/^action/).count(), 1);
await step("Fill").click();
await key("k");
await write("until it is full");
await isIn("// until it is full");

// Copies: in the chart, into another one, and back out.
await step("Fill").click();
await step("S3").click({ modifiers: ["Shift"] });
await page.waitForTimeout(500);
await key("Control+c");
await key("Control+v");
await step("Fill2").waitFor();
const steps = () => text(name).then((text) => text.match(/STEP \w+:/g).length);
assert.equal(await steps(), 22);
await key("Control+d");
await page.waitForFunction(
  (name) => globalThis.texts[name].match(/STEP \w+:/g).length === 24,
  name,
);
await key("Control+x");
await page.waitForFunction(
  (name) => globalThis.texts[name].match(/STEP \w+:/g).length === 22,
  name,
);
console.log("refusals, blocks, comments and copies");

// Places: a drag puts a step elsewhere, in steps of ten; arrows do; the layout is automatic again.
await load(page, file("drag.sfc", chain(4)), file("other.sfc"));
await step("S2").waitFor();
const before = await step("S2").boundingBox();
await drag(await middle(step("S2")), [before.x + 200, before.y + 30]);
await isIn("{at ", "drag.sfc");
const placed = await text("drag.sfc");
assert(
  [...placed.matchAll(/STEP S2:[^]*?\{at (-?\d+) (-?\d+)\}/g)].every(
    ([, x, y]) => x % 10 === 0 && y % 10 === 0,
  ),
  placed,
);
await key("Control+ArrowRight");
await page.waitForFunction((before) => globalThis.texts["drag.sfc"] !== before, placed);
await choose("Change", "Lay out");
await page.waitForFunction(() => !globalThis.texts["drag.sfc"].includes("{at"));
await key("Control+z");
await key("Control+z");
await key("Control+z");
await isText(chain(4), "drag.sfc");

// A band, a copy into another file, and what was found.
const corner = await step("S1").boundingBox();
await drag([corner.x - 12, corner.y - 12], [corner.x + 150, corner.y + 110]);
await page.waitForFunction(() => document.querySelectorAll(".sheets .selected").length === 3);
await page.waitForTimeout(500);
await key("Control+c");
await page.getByRole("button", { name: "other.sfc", exact: true }).click();
await button("First step").click();
await focused("^initial step S1$");
await key("Control+v");
await page.waitForFunction(() => /S2/.test(globalThis.texts["other.sfc"]));
await key("F12");
await page.getByRole("textbox", { name: "other.sfc" }).waitFor();
assert.equal(
  await page.evaluate(() => document.activeElement.className),
  "cm-content cm-lineWrapping".split(" ")[0],
);

// As a picture for a file.
const saved = page.waitForEvent("download");
await choose("View", "Save as SVG");
const picture = await readFile(await (await saved).path(), "utf8");
assert.match(picture, /^<svg[^]*S1[^]*<\/svg>$/);
assert.doesNotMatch(picture, /class=|var\(/);
console.log("places, a band, other files, pictures");

// A mistake in the text: the drawing is there, with the way to the mistake, and is not changed.
await load(page, file("broken.sfc", `${chain(3)}STEP\n`));
await step("S2").click();
const toMistake = chart.getByRole("button", { name: /^Line \d+$/ });
await toMistake.waitFor();
await key("n");
await page
  .getByRole("alert")
  .filter({ hasText: /mistake in line/ })
  .waitFor();
await toMistake.click();
await page.waitForFunction(() => document.activeElement.classList.contains("cm-content"));

// Fingers: a tap selects, two write, two fingers make it larger, one moves the ground.
const context = await browser.newContext({
  viewport: { width: 390, height: 844 },
  hasTouch: true,
  isMobile: true,
});
const phone = watched(await context.newPage(), errors);
await listen(phone);
await load(phone, file("finger.sfc", chain(12)));
const there = phone.getByRole("tabpanel", { name: "Chart", exact: true });
const touched = there.getByRole("button", { name: /^step S2$/ });
await touched.waitFor();
await there.locator(".stage").scrollIntoViewIfNeeded();
await touched.tap();
await there.locator(".selected").waitFor();
const client = await context.newCDPSession(phone);
const touch = (type, ...points) =>
  client.send("Input.dispatchTouchEvent", {
    type,
    touchPoints: points.map(([x, y], id) => ({ x, y, id })),
  });
const width = () => there.locator(".sheets svg").evaluate((svg) => svg.clientWidth);
const stage = await there.locator(".stage").boundingBox();
const [x, y] = [stage.x + stage.width / 2, stage.y + stage.height / 2];
const small = await width();
await touch("touchStart", [x - 20, y], [x + 20, y]);
for (let far = 20; far <= 40; far += 5) await touch("touchMove", [x - far, y], [x + far, y]);
await touch("touchEnd");
assert((await width()) > small * 1.5, "two fingers");
const top = () => there.locator(".sheets").evaluate((place) => place.scrollTop);
const high = await top();
await touch("touchStart", [x + 100, y]);
for (let far = 0; far <= 100; far += 20) await touch("touchMove", [x + 100, y - far]);
await touch("touchEnd");
assert((await top()) > high + 50, "one finger");
await touched.tap();
await touched.tap();
await there.getByRole("textbox", { name: "Name of step S2" }).fill("Tapped");
await phone.keyboard.press("Enter");
await there.getByRole("button", { name: /^step Tapped$/ }).waitFor();
const boxes = await there
  .locator("button:visible")
  .evaluateAll((buttons) =>
    buttons
      .map((button) => button.getBoundingClientRect())
      .map(({ width, height }) => [width, height]),
  );
assert(
  boxes.every(([width, height]) => width >= 44 && height >= 44),
  JSON.stringify(boxes),
);
await context.close();
console.log("mistakes, and fingers");

// A large chart is changed and scrolled, and the page stays free: tasks over 50 ms are rare.
await load(page, file("large.sfc", chain(LARGE)));
await step("S2").click();
await focused("^step S2$");
const frames = 100;
const { long, count } = await longTasks(browser, page, async () => {
  for (let edit = 1; edit <= EDITS; edit += 1) {
    await key("n");
    await focused(`^step S${LARGE + edit}$`);
  }
  await page.evaluate(async (frames) => {
    const place = document.querySelector(".sheets");
    for (let at = 0; at < frames; at += 1) {
      place.scrollTop = (place.scrollHeight * at) / frames;
      await new Promise((done) => requestAnimationFrame(done));
    }
  }, frames);
});
assert(count > frames, `${count} tasks were seen`);
console.log(`${LARGE} steps, ${EDITS} edits, ${frames} frames: tasks of ${long.join(", ")} ms`);
assert(long.length <= 0.05 * (EDITS + frames), "tasks over 50 ms");
assert.deepEqual(errors, []);
await browser.close();

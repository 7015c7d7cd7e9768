// What is true of charts in the page between two moments: marks while steps are inserted, where Tab
// leads while the drawing is scrolled, drags that are held, names and priorities of transitions.
// `node test/chart_moments.mjs ADDRESS`.
import assert from "node:assert/strict";
import { controls, open } from "./browser.mjs";
import { chain, file, listen, load, middle } from "./drawing_page.mjs";

/** So late the core says which steps there are. */
const LATE_MS = 800;

const [, , address] = process.argv;
const { browser, page, errors } = await open({ patience: 30_000 });
const { button, panel, mode } = controls(page);
const chart = panel("Chart");
const key = (name) => page.keyboard.press(name);
const write = async (words) => (await page.keyboard.type(words), await key("Enter"));
const part = (name) => chart.getByRole("button", { name });
const step = (name) => part(new RegExp(`^(initial )?step ${name}(,|$)`));
const transition = (title) => part(new RegExp(`^transition ${title}`));
const isIn = (words, name) =>
  page.waitForFunction(([words, name]) => globalThis.texts[name].includes(words), [words, name]);
const text = (name) => page.evaluate((name) => globalThis.texts[name], name);
const scrolled = () => chart.locator(".sheets").evaluate(({ scrollTop }) => scrollTop);

await listen(page);
// The core takes its time to say which steps there are.
await page.addInitScript((late) => {
  const Real = Worker;
  globalThis.Worker = class extends Real {
    postMessage(wish) {
      const send = () => super.postMessage(wish);
      if (typeof wish === "string" && JSON.parse(wish).do === "chart") setTimeout(send, late);
      else send();
    }
  };
}, LATE_MS);

// B and C are active in turn. While others are written before them and the program is started anew,
// none of those ever looks active.
const MARKED = `INITIAL_STEP A:
END_STEP
STEP B:
END_STEP
STEP C:
END_STEP
TRANSITION FROM A TO B := TRUE;
END_TRANSITION
TRANSITION FROM B TO C := B.T >= T#70ms;
END_TRANSITION
TRANSITION FROM C TO B := C.T >= T#110ms;
END_TRANSITION
`;
await load(page, address, file("marked.sfc", MARKED));
await button("Run").click();
await mode("RUN");
await page.waitForFunction(() => document.querySelector(".on [aria-label='step B, active']"));
await page.evaluate(() => {
  globalThis.marked = new Set();
  const note = () => {
    for (const node of document.querySelectorAll(".sheets .on [aria-label*='step ']"))
      globalThis.marked.add(node.getAttribute("aria-label"));
    requestAnimationFrame(note);
  };
  note();
});
const written = page.locator(".cm-line", { hasText: /^STEP B:$/ });
for (const name of ["D1", "D2", "D3"]) {
  await written.click();
  await key("Home");
  await page.keyboard.insertText(`STEP ${name}:\nEND_STEP\n`);
  await step(name).waitFor();
  await button("Run").click();
  await page.waitForTimeout(3 * LATE_MS);
}
const marked = await page.evaluate(() => [...globalThis.marked].toSorted().join());
assert.match(marked, /step B, active,step C, active$/);
assert.doesNotMatch(marked, /step D/);
console.log("marks stay at their steps while steps are inserted");

// Tab leads to one element, wherever the drawing is scrolled to, and readers hear it in order.
await load(page, address, file("long.sfc", chain(200)));
await step("S1").waitFor();
const scroll = async (part) => {
  await chart.locator(".sheets").evaluate((place, part) => {
    place.scrollTop = place.scrollHeight * part;
  }, part);
  await page.waitForTimeout(100);
};
const stops = () =>
  page
    .locator(".sheets [role=button][tabindex='0']")
    .evaluateAll((nodes) => nodes.map((node) => node.getAttribute("aria-label")));
const heard = (kind) =>
  page
    .locator(".sheets [role=button]")
    .evaluateAll(
      (nodes, kind) =>
        nodes.flatMap((node) => node.getAttribute("aria-label").match(kind)?.[1] ?? []),
      kind,
    );
for (const stop of ["initial step S1", "step S2"]) {
  for (const part of [1, 0.5, 0.4, 0.6, 0]) {
    await scroll(part);
    assert.deepEqual(await stops(), [stop], `scrolled to ${part}`);
    for (const kind of [/step S(\d+)/, /transition S(\d+)/]) {
      const numbers = (await heard(kind)).map(Number);
      assert(numbers.length > 3, `${numbers.length} of ${kind}`);
      assert.deepEqual(
        numbers,
        numbers.toSorted((a, b) => a - b),
      );
    }
  }
  await step("S2").click();
}
console.log("a stop for Tab, and the chart's order, wherever it is scrolled to");

// A band that is held at the edge goes on; what is dropped is the end of it.
await scroll(0);
const stage = await chart.locator(".sheets").boundingBox();
const bottom = stage.y + stage.height - 6;
const first = await step("S1").boundingBox();
const band = async () => {
  await page.mouse.move(stage.x + 8, first.y - 8);
  await page.mouse.down();
  await page.mouse.move(first.x + 120, bottom - 80);
  await page.mouse.move(first.x + 120, bottom);
  await page.waitForFunction(() => document.querySelector(".sheets").scrollTop > 1500);
};
await band();
await page.mouse.up();
await page.waitForFunction(() => document.querySelectorAll(".sheets .selected").length > 3);
const there = await scrolled();
await page.waitForTimeout(200);
assert.equal(await scrolled(), there, "it scrolls on after the drop");
await step("S1").waitFor({ state: "detached" });
await scroll(0);
assert.match(await step("S1").getAttribute("aria-pressed"), /true/);
// A step that is carried away stays with the pointer.
await step("S2").click();
await page.mouse.move(...(await middle(step("S2"))));
await page.mouse.down();
await page.mouse.move(first.x + 200, bottom - 80);
await page.mouse.move(first.x + 200, bottom);
await page.waitForFunction(() => document.querySelector(".sheets").scrollTop > 1500);
const carried = await step("S2").boundingBox();
assert(Math.abs(carried.y + carried.height / 2 - bottom) < 60, `${carried.y} ${bottom}`);
await page.mouse.up();
await isIn("{at ", "long.sfc");
const [, y] = /STEP S2 \{at -?\d+ (-?\d+)\}/.exec(await text("long.sfc"));
assert(Number(y) > 1500, y);
console.log("drags that are held at the edge");

// What is dropped belongs to the chart in which the drag began.
const two = `PROGRAM One\n${chain(2)}END_PROGRAM\nPROGRAM Two\n${chain(2)}END_PROGRAM\n`;
await load(page, address, file("two.sfc", two));
await step("S2").first().waitFor();
const from = await middle(step("S2").first());
await page.mouse.move(...from);
await page.mouse.down();
await page.mouse.move(from[0] + 60, from[1] + 10, { steps: 3 });
await page.evaluate(() => {
  const tabs = [...document.querySelectorAll(".chart [role=tab]")];
  tabs.find(({ textContent }) => textContent.includes("Two")).click();
});
await page.mouse.up();
await isIn("{at ", "two.sfc");
const [one, other] = (await text("two.sfc")).split("PROGRAM Two");
assert(one.includes("{at ") && !other.includes("{at "), await text("two.sfc"));
console.log("a drop belongs to the chart in which the drag began");

// Transitions: name and priority, with keys and with the mouse; each is one change of the text.
const NAMED = "named.sfc";
await load(page, address, file(NAMED, chain(3)));
await transition("S1_to_S2").click();
await key("t");
await write("Fast");
await isIn("TRANSITION Fast FROM S1 TO S2", NAMED);
await key("r");
await write("soon");
await chart.locator(".refusal").filter({ hasText: "whole number" }).waitFor();
await chart.getByRole("textbox", { name: "Priority of transition Fast" }).fill("2");
await key("Enter");
await isIn("TRANSITION Fast (PRIORITY := 2) FROM S1 TO S2", NAMED);
await transition("Fast").waitFor();
await key("Control+z");
await isIn("TRANSITION Fast FROM S1 TO S2", NAMED);
const choose = async (item) => {
  await button("Change").click();
  await page.getByRole("menuitem", { name: item }).click();
};
await transition("S2_to_S3").click();
await choose("Name of transition …");
await write("2 words");
await chart.locator(".refusal").filter({ hasText: /name/ }).waitFor();
await chart.getByRole("textbox", { name: /^Name of transition/ }).fill("Slow");
await key("Enter");
await isIn("TRANSITION Slow FROM S2 TO S3", NAMED);
await choose("Priority …");
await write("1");
await isIn("TRANSITION Slow (PRIORITY := 1) FROM S2 TO S3", NAMED);
await choose("Name of transition …");
await key("Delete");
await key("Enter");
await isIn("TRANSITION (PRIORITY := 1) FROM S2 TO S3", NAMED);
await step("S1").click();
await key("t");
await page
  .getByRole("alert")
  .filter({ hasText: /select a transition/ })
  .waitFor();
console.log("names and priorities of transitions");

assert.deepEqual(errors, []);
await browser.close();

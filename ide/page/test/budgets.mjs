// What the page may take, in a real Chromium: its size, times to the first message and after a key,
// speeds of the targets in it, scrolling, and its heap. `node test/budgets.mjs ADDRESS FOLDER [POLLS]`:
// a server, and the folder that it gives away. Other programs on a computer take time from this one,
// so a time may be a few times its budget before that is an error; sizes may not.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { basename, join } from "node:path";
import { gzipSync } from "node:zlib";
import { open } from "./browser.mjs";
import { innerFolder } from "./load.mjs";

const [, , address, folder, given] = process.argv;
/** How often the page is told something new before its heap is looked at again. */
const POLLS = Number(given ?? 20_000);
/** So many times a budget other programs may make of a time. */
const NOISE = 8;
const over = [];

function report(what, measured, unit, budget, isGood, isIn) {
  console.log(`${what}: ${measured} ${unit}, budget ${budget} ${unit}${isGood ? "" : ": OVER"}`);
  if (!isIn) over.push(what);
}
const most = (what, measured, unit, budget, noise = NOISE) =>
  report(what, measured, unit, budget, measured <= budget, measured <= budget * noise);
const least = (what, measured, unit, budget) =>
  report(what, measured, unit, budget, measured >= budget, measured >= budget / NOISE);
const median = (values) => values.toSorted((a, b) => a - b)[values.length >> 1];
const round = (value) => Math.round(value * 100) / 100;

const { browser, page, errors } = await open();
const asked = new Set();
page.on("request", (request) => asked.add(basename(new URL(request.url()).pathname)));
const button = (name) => page.getByRole("button", { name, exact: true });
const status = () => page.getByRole("status").first();
await page.addInitScript(() => {
  const Real = Worker;
  globalThis.Worker = class extends Real {
    constructor(...given) {
      super(...given);
      globalThis.core = this;
    }
  };
  // When the first message of the assembler is in the page.
  new MutationObserver((_, observer) => {
    if (!document.querySelector(".cm-lintRange-error")) return;
    globalThis.firstMs = performance.now();
    observer.disconnect();
  }).observe(document, { childList: true, subtree: true, attributes: true });
});

/** A project in the address. */
async function load(text, plant = null) {
  const content = { files: [{ name: "a.awl", text }], main: "a.awl", plant, view: "problems" };
  const { deflateSync } = await import("fflate");
  const part = Buffer.from(deflateSync(Buffer.from(JSON.stringify(content)))).toString("base64url");
  await page.goto("about:blank");
  await page.goto(`${address.replace(/\?.*/, "")}#project=${part}`);
  await page.getByRole("textbox", { name: "a.awl" }).waitFor();
}

/** A program of so many networks with five lines each. */
const networks = (count) =>
  Array.from({ length: count }, (_, number) => {
    const bit = `${number % 14}.${number % 8}`;
    return `NETWORK ${number + 1}\nLD     I0.${number % 6}\nA      M${bit}\nO      SM0.5\n=      M${bit}\n`;
  }).join("");

const mistake = "NETWORK 1\nLD     I9.9\n=      Q0.0\n";
const firsts = [];
for (let run = 0; run < 3; run += 1) {
  await load(`${mistake}// ${run}\n`);
  await page.waitForFunction(() => globalThis.firstMs > 0);
  firsts.push(await page.evaluate(() => globalThis.firstMs));
}
most("first message after loading", round(median(firsts)), "ms", 1000);

// Everything that is loaded before somebody can work; what draws charts is not.
const inner = await innerFolder(folder);
const isPart = (name) => /\.(js|css|wasm)$/.test(name) && name !== "sw.js";
const loaded = [...asked].filter(isPart);
assert(
  ["page.js", "worker.js", "ide_core_bg.wasm"].every((name) => asked.has(name)),
  `${loaded}`,
);
assert(!asked.has("ide_drawings_bg.wasm"), `${loaded}`);
const files = [...loaded.map((name) => join(inner, name)), join(folder, "index.html")];
const sizes = await Promise.all(files.map(async (file) => gzipSync(await readFile(file)).length));
most("page with its core, gzip", round(sizes.reduce((a, b) => a + b) / 1e6), "MB", 1.5, 1);

// A key in a thousand lines, until what it makes wrong is underlined.
await load(networks(200));
await page.evaluate(() => {
  globalThis.took = [];
  let began = 0;
  addEventListener("keydown", () => (began = performance.now()), true);
  new MutationObserver(() => {
    if (began === 0 || !document.querySelector(".cm-lintRange-error")) return;
    globalThis.took.push(performance.now() - began);
    began = 0;
  }).observe(document.querySelector(".cm-content"), {
    childList: true,
    subtree: true,
    attributes: true,
  });
});
await page.getByRole("textbox", { name: "a.awl" }).click();
await page.keyboard.press("Control+Home");
await page.keyboard.press("ArrowDown");
await page.keyboard.press("End");
for (let key = 0; key < 15; key += 1) {
  await page.keyboard.press("9");
  await page.locator(".cm-lintRange-error").first().waitFor();
  await page.keyboard.press("Backspace");
  await page.locator(".cm-lintRange-error").first().waitFor({ state: "detached" });
}
const took = await page.evaluate(() => globalThis.took);
assert(took.length >= 15, `${took}`);
most("a key in 1,000 lines until it is underlined", round(median(took)), "ms", 50);

/** How fast the target goes: its time for that of the computer. */
async function pace(seconds) {
  await page.getByRole("combobox", { name: "Speed" }).selectOption("0");
  return page.evaluate(async (ms) => {
    const times = [];
    const listen = ({ data }) => {
      for (const event of Array.isArray(data) ? data : [])
        if (event.is === "status") times.push([performance.now(), event.status.timeMs]);
    };
    await new Promise((done) => setTimeout(done, 1000));
    globalThis.core.addEventListener("message", listen);
    await new Promise((done) => setTimeout(done, ms));
    globalThis.core.removeEventListener("message", listen);
    const [[from, first], [to, last]] = [times[0], times.at(-1)];
    return (last - first) / (to - from);
  }, seconds * 1000);
}
await page.goto("about:blank");
await page.goto(`${address.replace(/\?.*/, "")}#example=station1`);
await button("Run").click();
await status().filter({ hasText: "RUN" }).waitFor();
least("simulator, station1 with its plant", round(await pace(5)), "x real time", 500);
await page.getByRole("combobox", { name: "Target" }).selectOption({ label: "Virtual Uno" });
await button("Run").click();
await status().filter({ hasText: "RUN" }).waitFor();
least("virtual Uno, station1 with its plant", round(await pace(5)), "x real time", 1);

// Two thousand networks that run, scrolled through.
await load(networks(2000));
await button("Run").click();
await status().filter({ hasText: "RUN" }).waitFor();
await browser.startTracing(page, { categories: ["toplevel", "__metadata", "blink.user_timing"] });
const frames = await page.evaluate(async () => {
  performance.mark("scrolls");
  const place = document.querySelector(".cm-scroller");
  const steps = 300;
  for (let at = 0; at < steps; at += 1) {
    place.scrollTop = (place.scrollHeight * at) / steps;
    await new Promise((done) => requestAnimationFrame(done));
  }
  return steps;
});
const { traceEvents } = JSON.parse((await browser.stopTracing()).toString());
const { pid, tid } = traceEvents.find(({ name }) => name === "scrolls");
// The time that the thread had the processor: what other programs take is not in it.
const tasks = traceEvents.filter(
  (event) => event.pid === pid && event.tid === tid && event.tdur > 0,
);
const long = tasks.filter(({ name, tdur }) => /RunTask$/.test(name) && tdur > 50_000);
assert(tasks.length > frames, `${tasks.length} tasks were seen`);
const share = (100 * long.length) / frames;
most("frames with a task over 50 ms, scrolling 2,000 networks", round(share), "%", 5, 1);

// What the core tells while a program runs, again and again.
await page.goto("about:blank");
await page.goto(`${address.replace(/\?.*/, "")}#example=station1`);
await button("Run").click();
await status().filter({ hasText: "RUN" }).waitFor();
await page.getByRole("tab", { name: "Watch", exact: true }).click();
for (const operand of ["Push", "Height"]) {
  await page.getByLabel("Operand or symbol").fill(operand);
  await page.keyboard.press("Enter");
}
const told = await page.evaluate(async () => {
  const { core } = globalThis;
  const take = core.onmessage;
  const news = [];
  core.onmessage = (event) => (news.push(event.data), take.call(core, event));
  await new Promise((done) => setTimeout(done, 5000));
  core.onmessage = take;
  globalThis.news = news;
  return news.length;
});
assert(told > 50, `${told} in 5 s`);
const client = await page.context().newCDPSession(page);
async function heap() {
  await client.send("HeapProfiler.collectGarbage");
  const { usedSize } = await client.send("Runtime.getHeapUsage");
  return usedSize;
}
const repeat = (polls) =>
  page.evaluate(async (polls) => {
    const { core, news } = globalThis;
    for (let poll = 0; poll < polls; poll += 1) {
      core.onmessage({ data: news[poll % news.length] });
      if (poll % 50 === 0) await new Promise((done) => requestAnimationFrame(done));
    }
  }, polls);
await button("Stop").click();
await repeat(2000);
const before = await heap();
await repeat(POLLS);
const growth = (100 * ((await heap()) - before)) / before;
most(`heap after ${POLLS} polls`, round(growth), "%", 5, 1);

assert.deepEqual(errors, []);
await browser.close();
assert.deepEqual(over, [], "over budget");

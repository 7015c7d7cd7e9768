// The page under a finger, on a tablet and on a telephone, in a real Chromium on the real core: run,
// force a value beside a line, change the tab, plot, put cursors. Nothing but taps.
// `node test/touch.mjs ADDRESS`.
import assert from "node:assert/strict";
import { open, watched } from "./browser.mjs";

const [, , given] = process.argv;
const SIZES = { tablet: [1024, 768], telephone: [390, 844] };
const { browser, errors } = await open();

for (const [device, [width, height]] of Object.entries(SIZES)) {
  const context = await browser.newContext({
    viewport: { width, height },
    hasTouch: true,
    isMobile: true,
  });
  const page = watched(await context.newPage(), errors);
  await page.goto(`${given.replace(/\?.*/, "")}#example=station1`);
  const button = (name) => page.getByRole("button", { name, exact: true });
  const tab = (name) => page.getByRole("tab", { name, exact: true }).tap();
  const panel = (name) => page.getByRole("tabpanel", { name, exact: true });
  const status = page.getByRole("status").first();

  await page.getByRole("textbox", { name: "station1.awl" }).waitFor();
  await button("Run").tap();
  await status.filter({ hasText: "RUN" }).waitFor();

  // A swipe leads to the instructions. A value beside a line: its menu forces it, the line shows it.
  const touch = await context.newCDPSession(page);
  const area = await page.locator(".cm-scroller").boundingBox();
  const value = page.locator(".live .value[title=AtTop]").first();
  for (let swipes = 0; swipes < 20 && !(await value.isVisible()); swipes += 1) {
    const x = area.x + area.width / 2;
    const bottom = area.y + area.height - 20;
    const finger = (type, y) =>
      touch.send("Input.dispatchTouchEvent", { type, touchPoints: y === null ? [] : [{ x, y }] });
    await finger("touchStart", bottom);
    for (let y = bottom; y > area.y + 20; y -= 20) await finger("touchMove", y);
    await finger("touchEnd", null);
    await page.waitForTimeout(500);
  }
  await value.tap();
  await page.getByRole("menuitem", { name: "Force AtTop to 1", exact: true }).tap();
  await page.locator(".live .value.forced").first().waitFor();

  // Another tab: what is forced is there, and is released by a tap.
  await tab("Watch");
  await panel("Watch").getByText("AtTop").first().waitFor();
  await button("Release all").tap();
  await page.locator(".live .value.forced").first().waitFor({ state: "detached" });

  // A plot: a signal is named, held, and looked at at two times.
  await tab("Oscilloscope");
  const scope = panel("Oscilloscope");
  const signal = scope.getByLabel("Signal", { exact: true });
  await signal.tap();
  await signal.fill("Height");
  await scope.getByRole("button", { name: "Add", exact: true }).tap();
  await page.waitForTimeout(2000);
  await scope.getByRole("button", { name: "Hold", exact: true }).tap();
  const plot = scope.locator(".u-over").first();
  await plot.scrollIntoViewIfNeeded();
  const box = await plot.boundingBox();
  for (const part of [0.3, 0.7])
    await plot.tap({ position: { x: box.width * part, y: box.height / 2 } });
  const cells = scope.getByRole("row").filter({ hasText: "Height" }).getByRole("cell");
  await cells.filter({ hasText: /^-?\d/ }).first().waitFor();

  // The board's and the plant's controls, and STOP.
  await tab("Plant");
  await panel("Plant").getByRole("switch").first().tap();
  await button("Stop").tap();
  await status.filter({ hasText: "STOP" }).waitFor();

  // Everything that is tapped is large enough for a finger (WCAG 2.5.8: 24 pixels).
  const small = await page.evaluate(() =>
    [...document.querySelectorAll("button, select, input, [role=tab]")]
      .filter((element) => element.checkVisibility())
      .map((element) => [element.getBoundingClientRect(), element.outerHTML.slice(0, 120)])
      .filter(([box]) => box.width > 0 && (box.height < 24 || box.width < 24))
      .map(([box, html]) => `${Math.round(box.width)} x ${Math.round(box.height)}: ${html}`),
  );
  assert.deepEqual(small, [], device);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  assert(wide <= 0, `${wide} pixels too wide on a ${device}`);
  await context.close();
  console.log(`under a finger on a ${device}: run, force, tabs, plot`);
}
assert.deepEqual(errors, []);
await browser.close();

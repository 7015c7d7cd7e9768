// Somebody new, in a real Chromium on the real core: the page is opened for the first time, with
// nothing in its address. What is on the screen alone leads to a lamp that blinks on the virtual Uno,
// and to an exercise that runs. `node test/first_steps.mjs ADDRESS`.
import assert from "node:assert/strict";
import { controls, open } from "./browser.mjs";

const [, , given] = process.argv;
const { browser, page, errors } = await open();
const seen = (element) => element.filter({ visible: true }).first();
const { mode } = controls(page);

await page.goto(given.replace(/\?.*/, ""));
await page.getByRole("textbox", { name: "blink.awl" }).waitFor();
// What is needed is to be seen without scrolling or opening anything.
const target = seen(page.getByRole("combobox", { name: "Target" }));
assert((await target.locator("option").allInnerTexts()).includes("Virtual Uno"));
await target.selectOption({ label: "Virtual Uno" });
await seen(page.getByRole("button", { name: "Run", exact: true })).click();
await mode("RUN");
// The board is there at once, and its first lamp goes on and off.
const lamp = page.locator("svg .led").filter({ visible: true }).first();
const isOn = () => lamp.evaluate((led) => led.classList.contains("on"));
const colours = new Set();
for (let tries = 0; tries < 200 && colours.size < 2; tries += 1) {
  colours.add(await isOn());
  await page.waitForTimeout(50);
}
assert.deepEqual([...colours].sort(), [false, true], "Q0.0 blinks");
console.log("first steps: Q0.0 blinks on the virtual Uno");

await page.getByRole("tab", { name: "Exercises", exact: true }).click();
const exercises = page.getByRole("tabpanel", { name: "Exercises", exact: true });
await exercises.getByRole("button", { name: "A lamp with a switch" }).click();
await page.getByRole("textbox", { name: "lamp.awl" }).waitFor();
await page.keyboard.press("F1");
await page.getByRole("dialog").getByRole("listitem").first().waitFor();
await page.keyboard.press("Escape");
await seen(page.getByRole("button", { name: "Run", exact: true })).click();
await mode("RUN");
await page.getByRole("tab", { name: "Plant", exact: true }).click();
await page
  .getByRole("tabpanel", { name: "Plant", exact: true })
  .getByRole("switch")
  .first()
  .click();
console.log("first steps: an exercise runs");

// Somebody in a hurry: Run is pressed before the example has arrived.
await page.addInitScript(() => {
  const real = globalThis.fetch;
  globalThis.fetch = async (...given) => {
    if (`${given[0]}`.includes("motor.json")) await new Promise((done) => setTimeout(done, 1500));
    return real(...given);
  };
});
await page.goto("about:blank");
await page.goto(`${given.replace(/\?.*/, "")}#example=motor`);
await seen(page.getByRole("button", { name: "Run", exact: true })).click();
assert.equal(await page.getByRole("textbox", { name: "motor.awl" }).count(), 0);
await mode("RUN");
await page.getByRole("textbox", { name: "motor.awl" }).waitFor();
assert.deepEqual(errors, []);
await browser.close();
console.log("first steps: Run waits for the example");

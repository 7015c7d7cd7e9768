// Diagrams of blocks as drawings, in a real Chromium on the real core: values on the simulator and on
// the virtual Uno, sliders, plots, the way to a line and back, zoom, keyboard, mistakes, languages.
// `node test/diagrams.mjs ADDRESS`.
import assert from "node:assert/strict";
import { controls, open } from "./browser.mjs";
import { output } from "./drawing_page.mjs";

const [, , given] = process.argv;
const { browser, page, errors } = await open({ patience: 120_000 });
const { button, tab, panel, mode } = controls(page);
const diagram = panel("Diagram");
const element = (name) => diagram.locator(".element").getByRole("button", { name });
const details = page.getByRole("region", { name: "Chosen element" });
const activeLine = (words) => page.locator(".cm-activeLine", { hasText: words }).waitFor();
const focused = () => page.evaluate(() => document.activeElement.getAttribute("aria-label"));

async function example(name, file) {
  await page.goto("about:blank");
  await page.goto(`${given.replace(/\?.*/, "")}#example=${name}`);
  await page.getByRole("textbox", { name: file }).waitFor();
  await tab("Diagram");
}

await example("control_loop-fbd", "control_loop.fbd");
await element(/^1: Beat EVERY$/).waitFor();
await element(/^2: Loop PID$/).waitFor();
await element(/^3: Capacitor LAG$/).waitFor();
assert.equal(await diagram.locator(".link").count(), 3);
assert.equal(await diagram.locator(".feedback").count(), 1, "the way back is dashed");

// The way to the text and back; arrows go along the order of execution.
await element(/^2: Loop/).click();
await page.keyboard.press("F12");
await activeLine(/^\{at 360 40\} Loop/);
await diagram.locator(".current", { hasText: "Loop" }).waitFor();
await element(/^2: Loop/).click();
await page.keyboard.press("ArrowRight");
assert.match(await focused(), /^3: Capacitor/);
await details.getByRole("heading", { name: "Capacitor: LAG" }).waitFor();
await page.keyboard.press("Home");
assert.match(await focused(), /^1: Beat/);
await page.keyboard.press("Escape");
await details.waitFor({ state: "hidden" });

// Larger by the button and by the wheel, and as large as fits.
const width = () =>
  diagram.locator(".sheets svg").evaluate((svg) => svg.getBoundingClientRect().width);
const before = await width();
await diagram.getByRole("button", { name: "Larger", exact: true }).click();
const larger = await width();
assert(larger > before);
await element(/^2: Loop/).hover();
await page.keyboard.down("Control");
await page.mouse.wheel(0, -200);
await page.keyboard.up("Control");
assert((await width()) > larger);
await diagram.getByRole("button", { name: "Fit", exact: true }).click();
const room = await diagram.locator(".sheets").evaluate((place) => place.clientWidth);
assert((await width()) <= room + 1, "all of it can be seen");

for (const target of ["Simulator", "Virtual Uno"]) {
  await page.getByRole("combobox", { name: "Target" }).selectOption({ label: target });
  await button("Run").click();
  await mode("RUN");
  await element(/^2: Loop/).click();
  // The set value is a variable that the diagram reads alone; what others give has no slider.
  await details.getByRole("slider", { name: "Slider for SP" }).fill("1");
  assert.equal(await details.getByRole("slider", { name: "Slider for PV" }).count(), 0);
  await output(page, /^3: Capacitor/, "Y", 0.99, 1.01);
  await output(page, /^2: Loop/, "U", 0.99, 1.01);
  // A parameter, while it runs.
  await details.getByRole("slider", { name: "Slider for HIGH" }).fill("0.5");
  await output(page, /^3: Capacitor/, "Y", 0.49, 0.51);
  await details.getByRole("button", { name: "Main.Loop.HIGH = 0.5" }).click();
  await page.getByRole("menuitem", { name: "Set Main.Loop.HIGH" }).click();
  await page.getByRole("dialog").getByRole("textbox").fill("5.0");
  await page.keyboard.press("Enter");
  await output(page, /^3: Capacitor/, "Y", 0.99, 1.01);
  await button("Stop").click();
  await mode("STOP");
  await button("Reset").click();
  await button("Stop").click();
  console.log(`a diagram: values and sliders on ${target}`);
}

// What is chosen to be plotted is in the oscilloscope.
await page.getByRole("combobox", { name: "Target" }).selectOption({ label: "Simulator" });
await button("Run").click();
await mode("RUN");
await element(/^3: Capacitor/).click();
await details.getByRole("button", { name: "Plot Main.Capacitor.Y" }).click();
await panel("Oscilloscope").locator("figcaption", { hasText: "Main.Capacitor.Y" }).waitFor();
// The watch table and the diagram do not take each other's values.
await tab("Watch");
await page.getByLabel("Operand or symbol").fill("Main.Setpoint");
await page.keyboard.press("Enter");
await page.getByLabel("New value of Main.Setpoint").fill("2.0");
await page.getByRole("button", { name: "Set Main.Setpoint", exact: true }).click();
await panel("Watch").getByRole("cell", { name: "2.0", exact: true }).waitFor();
await tab("Diagram");
await output(page, /^3: Capacitor/, "Y", 1.98, 2.02);
await button("Stop").click();
await mode("STOP");

// What the text says is drawn while it is written; a mistake is told and leads to its place.
await page.getByRole("textbox", { name: "control_loop.fbd" }).click();
await page.getByText("{at 80 40} Beat();").click();
await page.keyboard.press("End");
await page.keyboard.press("Enter");
await page.keyboard.insertText("{at 80 240} %Q0.0 := Beat.Q;");
await element(/^\d: %Q0\.0 :=$/).waitFor();
await page.keyboard.press("Enter");
await page.keyboard.insertText("RETURN;");
await diagram.getByRole("status").getByRole("button", { name: "Show the place" }).click();
await activeLine(/^RETURN;/);
await page.getByRole("button", { name: "control_loop.scn", exact: true }).click();
await diagram.getByText(/where the editor has one with diagrams/).waitFor();

// Feedback from several elements, and the words of other languages.
await example("ball-fbd", "ball.fbd");
await element(/^2: Place_control PI_D$/).waitFor();
for (const [language, name] of [
  ["de", "Bausteinplan"],
  ["es", "Diagrama"],
]) {
  await page.evaluate((language) => localStorage.setItem("uno200.language", language), language);
  await page.reload();
  await page.getByRole("tab", { name, exact: true }).click();
  const named = page.getByRole("group", { name: new RegExp(`^${name} Main$`, "i") });
  await named.waitFor();
}
assert.deepEqual(errors, []);
await browser.close();
console.log("a diagram: drawn, followed, and read");

// The figures of a step response in Capture, in a real Chromium on the real core: of a simulation, to
// a number, between cursors, in all languages; of a closed loop that answers like a lag of
// 0.25 s, simulated, and recorded while its set value is changed. `node test/step_response.mjs ADDRESS`.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { deflateSync } from "fflate";
import { controls, open } from "./browser.mjs";

const [, , given] = process.argv;
const address = given.replace(/\?.*/, "");
const { browser, page, errors } = await open();
const { button, tab, panel, mode } = controls(page);
const capture = panel("Capture");
const select = (name) => capture.getByRole("combobox", { name, exact: true });
const figures = capture.getByRole("table", { name: "Step response" });
const figure = (name) => figures.getByRole("row", { name }).getByRole("cell").innerText();

async function near(name, wanted, tolerance) {
  const measured = Number.parseFloat(await figure(name));
  assert(Math.abs(measured - wanted) <= tolerance, `${name}: ${measured}, not ${wanted}`);
}

async function choose(signals) {
  await tab("Capture");
  for (const signal of signals) {
    await capture.getByLabel("Signal", { exact: true }).fill(signal);
    await page.keyboard.press("Enter");
  }
}

/** Opens a project of one file. */
async function openFile(name, text) {
  const content = { files: [{ name, text }], main: name, plant: null };
  const part = Buffer.from(deflateSync(Buffer.from(JSON.stringify(content)))).toString("base64url");
  await page.goto("about:blank");
  await page.goto(`${address}#project=${part}`);
  await page.getByRole("textbox", { name }).waitFor();
}

/** A lag of integers, which stays a bit below 1000. */
const LAG =
  "PROGRAM Main\nVAR\n    Level : INT;\n    Wanted : INT := 1000;\nEND_VAR\n" +
  "Level := Level + (Wanted - Level) / 8;\nEND_PROGRAM\n";
const SCAN = 0.01;
/** The level at the end of each scan, and what it does like a lag. */
const levels = [0];
while (levels.length < 200) levels.push(levels.at(-1) + Math.floor((1000 - levels.at(-1)) / 8));
const T = -SCAN / Math.log(1 - 1 / 8);

await openFile("lag.st", LAG);
await choose(["Main.Level", "Main.Wanted"]);
await capture.getByLabel("Seconds", { exact: true }).fill("2");
await capture.getByLabel("Step in ms", { exact: true }).fill("10");
await button("Simulate").click();
await capture.getByText(/s simulated/).waitFor();

// Loaded when it is opened, by keyboard.
const asked = [];
page.on("request", (request) => asked.push(request.url()));
await capture.getByText("Step response", { exact: true }).focus();
await page.keyboard.press("Enter");
await figures.waitFor();
assert(
  asked.some((url) => /step_table/.test(url)),
  `${asked}`,
);
assert.equal(await select("Signal that answers").inputValue(), "Main.Level");
assert.equal(await figure("Steady-state error"), "–", "without a set value there is none");
await near("Value after", levels.at(-1), 1e-3);
await near("Rise time", 2.1972 * T, 1.5 * SCAN);
await near("Settling time", 3.912 * T, 2.5 * SCAN);
await near("Overshoot", 0, 0);

// To a set value: a signal, or a number.
await select("Set value").selectOption("Main.Wanted");
await near("Step at", 0, SCAN);
await near("Steady-state error", 1000 - levels.at(-1), 1e-3);
const integral = levels.reduce((sum, level) => sum + (1000 - level) * SCAN, 0);
await near("IAE", integral, 1000 * SCAN);
await select("Set value").selectOption({ label: "a number" });
const number = capture.getByLabel("Number", { exact: true });
await number.fill("1010");
await near("Steady-state error", 1010 - levels.at(-1), 1e-3);
await number.fill("");
assert.equal(await figure("Steady-state error"), "–", "a field that is empty is no number");

// What has no step, and what has had no time to settle.
await select("Signal that answers").selectOption("Main.Wanted");
await capture.getByText(/there is no step/).waitFor();
assert.equal(await figure("Overshoot"), "–");
await select("Signal that answers").selectOption("Main.Level");
await capture.getByText("Cursors", { exact: true }).click();
await capture.getByLabel("Time of cursor A").fill("0");
await capture.getByLabel("Time of cursor B").fill("0.1");
await capture.getByText(/has not settled/).waitFor();
for (const name of ["Value after", "Rise time", "Overshoot", "Settling time"])
  assert.equal(await figure(name), "–", name);
await capture.getByLabel("Time of cursor B").fill("");
await near("Rise time", 2.1972 * T, 1.5 * SCAN);
console.log("a simulation: figures, a number as the set value, no step, a range");

/** Those of a lag of 0.25 s; the controller acts every 50 ms, so a time may be two of them off. */
async function isClosedLoop(size) {
  await near("Rise time", 2.1972 * 0.25, 0.11);
  await near("Overshoot", 0, 0.99);
  await near("Settling time", 3.912 * 0.25, 0.2);
  await near("Steady-state error", 0, 0.01);
  await near("Value after", size, 0.01);
  await near("IAE", size * 0.25, size * 0.06);
}

// The closed loop is simulated with its set value from the beginning.
const loop = await readFile(
  new URL("../../../examples/fbd/control_loop.fbd", import.meta.url),
  "utf8",
);
await openFile("loop.fbd", loop.replace("Setpoint : REAL;", "Setpoint : REAL := 1.0;"));
await choose(["Main.Capacitor.Y", "Main.Setpoint"]);
await capture.getByLabel("Seconds", { exact: true }).fill("4");
await button("Simulate").click();
await capture.getByText(/s simulated/).waitFor();
await capture.getByText("Step response", { exact: true }).click();
await select("Set value").selectOption("Main.Setpoint");
await isClosedLoop(1);
await near("Step at", 0, 0);
console.log("a simulation: the closed loop answers like a lag of 0.25 s");

// The simulator is recorded while the set value is changed.
await page.goto("about:blank");
await page.goto(`${address}#example=control_loop-fbd`);
await page.getByRole("textbox", { name: "control_loop.fbd" }).waitFor();
await choose(["Main.Capacitor.Y", "Main.Setpoint"]);
await button("Run").click();
await mode("RUN");
await tab("Watch");
await page.getByLabel("Operand or symbol").fill("Main.Setpoint");
await page.keyboard.press("Enter");
const field = page.getByLabel("New value of Main.Setpoint");
await field.waitFor();
await tab("Capture");
await capture.getByLabel("Seconds", { exact: true }).fill("6");
await capture.getByLabel("Step in ms", { exact: true }).fill("10");
await button("Record").click();
await capture.getByText(/Recording: [01]/).waitFor();
await tab("Watch");
await field.fill("0.8");
await page.getByRole("button", { name: "Set Main.Setpoint", exact: true }).click();
await tab("Capture");
await capture.getByText("s of the target recorded").waitFor();
await capture.getByText("Step response", { exact: true }).click();
await select("Set value").selectOption("Main.Setpoint");
await isClosedLoop(0.8);
await near("Value before", 0, 0.01);
await near("Step at", 2, 1.95);
console.log("a recording: the closed loop answers like a lag of 0.25 s");

for (const [language, tabName, simulate, title, name] of [
  ["de", "Aufzeichnen", "Simulieren", "Sprungantwort", "Anstiegszeit"],
  ["es", "Registrar", "Simular", "Respuesta al escalón", "Tiempo de subida"],
]) {
  await page.evaluate((language) => localStorage.setItem("uno200.language", language), language);
  await openFile("lag.st", LAG);
  await page.getByRole("tab", { name: tabName, exact: true }).click();
  await page.locator(".signals:visible input").fill("Main.Level");
  await page.keyboard.press("Enter");
  await button(simulate).click();
  await page.locator("summary", { hasText: title }).click();
  const row = page.getByRole("table", { name: title }).getByRole("row", { name });
  await row.getByRole("cell", { name: /^0\.\d+ s$/ }).waitFor();
}
assert.deepEqual(errors, []);
await browser.close();
console.log("its words are in all languages");

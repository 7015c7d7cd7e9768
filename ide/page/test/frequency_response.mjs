// The frequency response in Capture, in a real Chromium on the real core: of a lag, by keyboard alone;
// of a closed loop, and of the open loop in it; refusals; in both themes and all languages.
// `node test/frequency_response.mjs ADDRESS [FOLDER FOR PICTURES]`.
import assert from "node:assert/strict";
import { deflateSync } from "fflate";
import { controls, open } from "./browser.mjs";

const [, , given, pictures] = process.argv;
const address = given.replace(/\?.*/, "");
const { browser, page, errors } = await open({ height: 1100 });
const { button, tab, panel } = controls(page);
const capture = panel("Capture");
const field = (name) => capture.getByLabel(name, { exact: true });
const figures = capture.getByRole("table", { name: /^Frequency response/ });
const figure = (name) => figures.getByRole("row", { name }).getByRole("cell").innerText();

async function openText(text) {
  const content = { files: [{ name: "a.st", text }], main: "a.st", plant: null };
  const part = Buffer.from(deflateSync(Buffer.from(JSON.stringify(content)))).toString("base64url");
  await page.goto("about:blank");
  await page.goto(`${address}#project=${part}`);
  await page.getByRole("textbox", { name: "a.st" }).waitFor();
  await tab("Capture");
  await field("Step in ms").fill("10");
}

async function near(name, numbers, tolerance) {
  const found = [...(await figure(name)).matchAll(/-?\d+(\.\d+)?/g)].map((match) =>
    Number(match[0]),
  );
  assert.equal(found.length, numbers.length, `${name}: ${found}`);
  for (const [index, number] of numbers.entries())
    assert(Math.abs(found[index] / number - 1) <= tolerance, `${name}: ${found}, not ${numbers}`);
}

async function picture(name) {
  if (!pictures) return;
  await figures.scrollIntoViewIfNeeded();
  await page.screenshot({ path: `${pictures}/${name}.png` });
}

const LAG = `PROGRAM Main
VAR
    Input : REAL;
    Slow : LAG;
END_VAR
Slow(X := Input, T1 := T#200ms, TS := T#10ms);
END_PROGRAM
`;

// Opened, filled in and measured without a mouse.
await openText(LAG);
await capture.getByText(/^Frequency response/).focus();
await page.keyboard.press("Enter");
await field("Excite").waitFor();
await page.keyboard.press("Tab");
await page.keyboard.type("Main.Input");
await page.keyboard.press("Tab");
await page.keyboard.press("Tab");
await page.keyboard.type("Main.Slow.Y");
await page.keyboard.press("Enter");
await figures.waitFor();
// 1 / (2 pi 0.2 s) = 0.796 Hz; with samples of 10 ms it is 0.808.
await near("Bandwidth", [0.808], 0.005);
assert.equal(await figure("Phase margin"), "–", "the gain never comes from above 0 dB");
assert.equal(await capture.locator(".sweep canvas").count(), 2);
assert.equal(await capture.locator(".sweep .bad").innerText(), "", "nothing to be careful with");
console.log("a lag: measured by keyboard, its bandwidth is that of its equation");

// The pointer reads a frequency off.
await capture.locator(".sweep .u-over").first().hover();
await capture.getByText(/^[\d.]+ Hz: -[\d.]+ dB, -[\d.]+°, distortion 0 %$/).waitFor();
const download = page.waitForEvent("download");
await capture.locator(".sweep").getByRole("button", { name: "CSV" }).click();
assert.equal((await download).suggestedFilename(), "a_sweep.csv");
await picture("lag");

// What cannot be measured is said.
await field("Excite").fill("Main.Slow.Y");
await button("Measure").click();
await page.getByText(/writes .* itself, so the sine does not stay/).waitFor();
await field("Excite").fill("Main.Input");
await field("To Hz").fill("80");
await button("Measure").click();
await page.getByText(/less than 50\.00 Hz/).waitFor();
console.log("refusals: what the program writes, what is too fast");

/**
 * 4 / (1 + s)^3, sampled every 10 ms: 4 p^3 / (1 - (1 - p) / z)^3 with p = 1 - exp(-0.01), of which the
 * margins are 28.20 degrees at 0.1962 Hz and 6.423 dB at 0.2814 Hz.
 */
const LOOP = `PROGRAM Main
VAR
    Wanted, Error : REAL;
    A, B, C : LAG := (T1 := T#1s, TS := T#10ms);
END_VAR
Error := Wanted - C.Y;
A(X := 4.0 * Error);
B(X := A.Y);
C(X := B.Y);
END_PROGRAM
`;
await openText(LOOP);
await capture.getByText(/^Frequency response/).click();
await field("Excite").fill("Main.Wanted");
await field(/^Path from/).fill("Main.Error");
await field("Path to").fill("Main.C.Y");
await field("From Hz").fill("0.02");
await field("To Hz").fill("2");
await button("Measure").click();
await figures.waitFor();
// Between the frequencies that are measured the curves are taken as straight.
await near("Gain margin", [6.423, 0.2814], 0.02);
await near("Phase margin", [28.2, 0.1962], 0.02);
await picture("loop");
console.log("an open loop in the closed one: its margins");

await page.emulateMedia({ colorScheme: "dark" });
await picture("loop_dark");
for (const [language, tabName, title, words] of [
  ["de", "Aufzeichnen", "Frequenzgang", "Anregen"],
  ["es", "Registrar", "Respuesta en frecuencia", "Excitar"],
]) {
  await page.evaluate((language) => localStorage.setItem("uno200.language", language), language);
  await page.reload();
  await page.getByRole("tab", { name: tabName, exact: true }).click();
  await page.locator("summary", { hasText: title }).click();
  await page.getByLabel(words, { exact: true }).waitFor();
}
assert.deepEqual(errors, []);
await browser.close();
console.log("its words are in all languages");

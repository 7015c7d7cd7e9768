// Charts of SFCEdit as Structured Text for other controllers, in a real Chromium on the real core: the
// kinds of variables, suggested and chosen, by mouse and by keys; texts for four targets; the table
// as a file. `node test/set_reset.mjs ADDRESS [FOLDER]`: a folder for pictures.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { open } from "./browser.mjs";
import { file, load } from "./drawing_page.mjs";

const [, , address, pictures] = process.argv;
const { browser, page, errors } = await open({ patience: 30_000 });
const AXE = await readFile(new URL("../node_modules/axe-core/axe.min.js", import.meta.url), "utf8");
const dialog = page.getByRole("dialog");
const control = (name) => dialog.getByLabel(name, { exact: true });
const example = new URL("../../../lang/chart/tests/sfcedit/ejemplo.xml", import.meta.url);
const chart = (await readFile(example, "utf8")).replace(
  "<text>A1</text></action>",
  "<text>A1</text></action><action type='normal'><text>Temp1 := T#5s</text></action>" +
    "<action type='normal'><text>Cont1 := 3</text></action>",
);

await load(page, address, file("ejemplo.xml", chart));
const begin = page.getByRole("button", { name: "Structured Text for a controller …" });
await begin.click();
// Suggestions from use, in three tables.
for (const [name, table] of [
  ["T0_1", "Signals"],
  ["Temp1", "Timers"],
  ["Cont1", "Counters"],
])
  await dialog.getByRole("table", { name: table }).getByRole("rowheader", { name }).waitFor();
assert.equal(await control("Kind: T0_1").inputValue(), "input");
assert.equal(await control("Kind: A1").inputValue(), "output");
assert.equal(await control("Type: Temp1").inputValue(), "TON");

// Another kind, by keys; a timer is in its table then.
await control("Kind: T0_1").focus();
await page.keyboard.press("m");
await page.waitForFunction(() => {
  const row = [...document.querySelectorAll("dialog tr")].find((one) =>
    one.textContent.startsWith("T0_1"),
  );
  return !row.classList.contains("guessed") && row.querySelector("select").value === "memory";
});
assert.equal(
  await page.evaluate(() => document.activeElement.getAttribute("aria-label")),
  "Kind: T0_1",
);
await control("Kind: T1_23").selectOption("timer");
await dialog
  .getByRole("table", { name: "Timers" })
  .getByRole("rowheader", { name: "T1_23" })
  .waitFor();
await control("Kind: T1_23").selectOption("constant");
await control("Value: T1_23").fill("TRUE");
await control("Value: T1_23").press("Tab");
if (pictures)
  for (const theme of ["light", "dark"]) {
    await page.evaluate((theme) => (document.documentElement.dataset.theme = theme), theme);
    await page.waitForTimeout(200);
    await page.screenshot({ path: join(pictures, `set-reset-${theme}.png`) });
    await page.evaluate(AXE);
    const { violations } = await page.evaluate(() => window.axe.run());
    assert.deepEqual(
      violations.map(({ id, nodes }) => [id, nodes[0].html]),
      [],
    );
  }

// The table becomes a file of the project, and is taken from there the next time.
await dialog.getByRole("button", { name: "Keep the table (.csv)" }).click();
await dialog.getByRole("button", { name: "Cancel", exact: true }).click();
await page.getByRole("button", { name: "ejemplo.csv", exact: true }).waitFor();
for (const [target, words, ending] of [
  ["uno200", "FUNCTION_BLOCK GEjemplo", "st"],
  ["twincat", "FUNCTION_BLOCK GEjemplo", "st"],
  ["pl7", "%", "st"],
  ["plcopen", "<project", "xml"],
]) {
  await begin.click();
  assert.equal(await control("Kind: T0_1").inputValue(), "memory");
  assert.equal(await control("Value: T1_23").inputValue(), "TRUE");
  await control("Controller").selectOption(target);
  const save = dialog.getByRole("button", { name: "Save the text" });
  await page.waitForTimeout(200);
  const download = page.waitForEvent("download");
  await save.click();
  const saved = await download;
  assert(saved.suggestedFilename().endsWith(`.${ending}`), saved.suggestedFilename());
  assert((await readFile(await saved.path(), "utf8")).includes(words), target);
}

// What runs here is added to the project; what the table has wrong is said.
await begin.click();
await dialog.getByRole("button", { name: "Add to the project" }).click();
await page.getByRole("textbox", { name: "ejemplo.st" }).waitFor();
await page.getByRole("button", { name: "ejemplo.csv", exact: true }).click();
await page.getByRole("textbox", { name: "ejemplo.csv" }).click();
await page.keyboard.press("Control+A");
await page.keyboard.insertText("T0_1,memori,BOOL\n");
await page
  .getByRole("button", { name: /^ejemplo\.xml/ })
  .first()
  .click();
await begin.click();
await dialog.getByText(/memori/).waitFor();
assert(await dialog.getByRole("button", { name: "Add to the project" }).isDisabled());
assert.deepEqual(errors, []);
await browser.close();
console.log("charts of SFCEdit: kinds of variables, four targets, the table");

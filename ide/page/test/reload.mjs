// What people have done stays, in a real Chromium: a symbol that is renamed in several files is one
// step for Undo; a reload keeps texts, and what the virtual Uno retains. `node test/reload.mjs
// ADDRESS`
import assert from "node:assert/strict";
import { deflateSync } from "fflate";
import { open } from "./browser.mjs";

const [, , address] = process.argv;
const { browser, page, errors } = await open();
const plain = address.replace(/\?.*/, "");
const button = (name) => page.getByRole("button", { name, exact: true });
/** A file in the list of all. */
const row = (file) => page.locator(`[data-file="${file}"]`);
const editor = (name) => page.getByRole("textbox", { name });
const message = (text) => page.locator(".notice").filter({ hasText: text }).first();

const FILES = {
  "motor.awl": "NETWORK 1\nLD     Start\n=      Q0.0\n",
  "motor.csv": "Start\tI0.0\tgreen button\n",
  "motor.scn": "at 0ms Start = 1\nat 10ms expect Q0.0 = 1\nrun 20ms\n",
};

async function load(files, main) {
  const content = { files: Object.entries(files).map(([name, text]) => ({ name, text })), main };
  const packed = deflateSync(Buffer.from(JSON.stringify(content)));
  await page.goto("about:blank");
  await page.goto(`${plain}#project=${Buffer.from(packed).toString("base64url")}`);
  await editor(main).waitFor();
}

/** The text of a file, from the top. */
async function text(name) {
  await row(name).click();
  return (await editor(name).innerText()).replaceAll(" ", "");
}

async function allHave(word) {
  for (const name of Object.keys(FILES)) {
    await row(name).click();
    await editor(name).filter({ hasText: word }).waitFor();
  }
}

async function renameSymbol(to) {
  await row("motor.awl").click();
  await page.locator(".cm-line").filter({ hasText: /^LD/ }).click();
  await page.keyboard.press("End");
  await page.keyboard.press("F2");
  await page.getByLabel("New name").fill(to);
  await button("Rename").click();
  await message("places changed: 3").waitFor();
}

async function press(file, key) {
  await row(file).click();
  await editor(file).click();
  await page.keyboard.press(key);
}

await load(FILES, "motor.awl");
await renameSymbol("Go");
await allHave("Go");
// Undone in a file that was not even open, and redone in another one.
await press("motor.scn", "Control+z");
await allHave("Start");
await press("motor.csv", "Control+y");
await allHave("Go");
await press("motor.awl", "Control+z");
await allHave("Start");
// A file that has gone on keeps what was written; that is said.
await renameSymbol("Begin");
await press("motor.scn", "Control+Home");
await page.keyboard.type("# later\n");
await press("motor.awl", "Control+z");
await message("It was not undone in motor.scn").waitFor();
await row("motor.csv").click();
await editor("motor.csv").filter({ hasText: "Start" }).waitFor();
assert.match(await text("motor.scn"), /#later\nat0msBegin/);
// Undo there goes back to it, and the file is as the others again.
for (let tries = 0; !/^at0msStart/.test(await text("motor.scn")); tries += 1) {
  assert(tries < 20, await text("motor.scn"));
  await press("motor.scn", "Control+z");
}
await allHave("Start");
await press("motor.csv", "Control+Home");
await page.keyboard.type("\n");
await press("motor.awl", "Control+y");
await message("It was not redone in motor.csv").waitFor();

// A file with another name has its history.
await load({ ...FILES, "motor.awl": `${FILES["motor.awl"]}// another one\n` }, "motor.awl");
await renameSymbol("Go");
await button("More about motor.scn").click();
await page.getByRole("menuitem", { name: "Rename …" }).click();
await page.getByLabel("New name").fill("first.scn");
await button("Rename").click();
await row("first.scn").click();
await editor("first.scn").filter({ hasText: "Go" }).waitFor();
await press("motor.awl", "Control+z");
await row("first.scn").click();
await editor("first.scn").filter({ hasText: "Start" }).waitFor();

// The EEPROM of the virtual Uno: it counts on where it was.
const counter = { "count.awl": "//# retain MW0\nLD SM0.1\nINCW MW0\n" };
await load(counter, "count.awl");
const count = async (expected) => {
  await page.getByRole("combobox", { name: "Target" }).selectOption({ label: "Virtual Uno" });
  await button("Run").click();
  await page.getByRole("status").first().filter({ hasText: "RUN" }).waitFor();
  await page.getByRole("tab", { name: "Watch", exact: true }).click();
  const rows = page
    .getByRole("tabpanel", { name: "Watch" })
    .getByRole("row")
    .filter({ hasText: "MW0" });
  if ((await rows.count()) === 0) {
    await page.getByLabel("Operand or symbol").fill("MW0");
    await page.keyboard.press("Enter");
  }
  await rows.getByRole("cell", { name: String(expected), exact: true }).waitFor();
  // Until the board has written it, and the page has kept that.
  await page.waitForTimeout(3000);
};
await count(1);
await page.reload();
await editor("count.awl").waitFor();
await count(2);
assert.deepEqual(errors, []);
await browser.close();
console.log("Undo is one step across files, and a reload keeps texts and EEPROM");

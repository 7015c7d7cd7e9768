// A folder of this computer as the project, in a real Chromium: what is written in the page is saved
// there, what others write there appears in the page, and nothing is overwritten that nobody has
// seen. `node test/folder.mjs ADDRESS FOLDER PID`: the server's address with its token, the folder
// that it was given, and its process, which ends before the test does.
import assert from "node:assert/strict";
import { readFile, readdir, rm, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { setTimeout as sleep } from "node:timers/promises";
import { open } from "./browser.mjs";

const [, , address, folder, pid] = process.argv;
const { browser, page, errors } = await open();
const file = (name) => join(folder, name);
const text = (name) => readFile(file(name), "utf8");
const button = (name) => page.getByRole("button", { name, exact: true });
const lamp = page.getByRole("textbox", { name: "lamp.awl" });

/** Waits until a file has this text. */
async function until(name, wanted) {
  for (let tries = 0; tries < 100; tries += 1) {
    if ((await text(name).catch(() => null)) === wanted) return;
    await sleep(100);
  }
  assert.equal(await text(name), wanted);
}

/** Puts the cursor at the end of the text, and writes. */
async function write(words) {
  await lamp.click();
  await page.keyboard.press("Control+End");
  await page.keyboard.type(words);
}

await page.goto(address);
await lamp.filter({ hasText: "Lüfter" }).waitFor();
assert(!page.url().includes("token"), page.url());
// What is left out is told.
await page.getByRole("alert").filter({ hasText: "link.txt" }).waitFor();
await page.getByRole("button", { name: "Close the message" }).click();
await button("Project").click();
await page.getByRole("menuitemradio", { name: "Folder lamp", checked: true }).waitFor();
await page.keyboard.press("Escape");

// What is written is saved, in the encoding and with the line ends that the file had.
await write("= Q0.0\n");
const bytes = Buffer.from("// L\xfcfter\r\nLD I0.0\r\n= Q0.0\r\n", "latin1");
for (let tries = 0; !bytes.equals(await readFile(file("lamp.awl"))); tries += 1) {
  assert(tries < 100, (await readFile(file("lamp.awl"))).toString("latin1"));
  await sleep(100);
}
await page.keyboard.press("Control+s");
await page.getByText("Saved into the folder lamp").waitFor();

// What somebody else writes appears, and can be undone.
await writeFile(file("lamp.awl"), "LD I0.5\n= Q0.0\n");
await lamp.filter({ hasText: "I0.5" }).waitFor();
await page.getByText("lamp.awl was changed in the folder").waitFor();
await writeFile(file("new.awl"), "LD I0.2\n");
await button("new.awl").waitFor();
await rm(file("new.awl"));
await button("new.awl").waitFor({ state: "detached" });

// Both at once: nothing is overwritten before somebody has chosen.
const conflict = page.getByRole("dialog", { name: "lamp.awl was changed in the folder, and here" });
const both = async (theirs, mine) => {
  // A page that nobody sees does not look at the folder, so it cannot have seen this before.
  const see = (state) =>
    page.evaluate((value) => {
      Object.defineProperty(document, "visibilityState", { value, configurable: true });
    }, state);
  await see("hidden");
  await writeFile(file("lamp.awl"), theirs);
  await write(mine);
  await conflict.waitFor();
  await see("visible");
  assert.equal(await text("lamp.awl"), theirs);
};
await both("LD I0.3\n", "// mine\n");
await conflict.getByRole("button", { name: /^Keep what is here/ }).click();
await until("lamp.awl", "LD I0.5\n= Q0.0\n// mine\n");
await both("LD I0.4\n", "// and this\n");
await conflict.getByRole("button", { name: /^Take what is in the folder/ }).click();
await lamp.filter({ hasText: "I0.4" }).waitFor();
await lamp.click();
await page.keyboard.press("Control+z");
await lamp.filter({ hasText: "and this" }).waitFor();
await until("lamp.awl", "LD I0.5\n= Q0.0\n// mine\n// and this\n");
await both("LD I0.1\n", "// undecided\n");
await conflict.getByRole("button", { name: "Close", exact: true }).click();
await page.getByRole("alert").filter({ hasText: "lamp.awl is not saved" }).waitFor();
await sleep(2500);
assert.equal(await text("lamp.awl"), "LD I0.1\n");
// A reload forgets neither the text nor that it is undecided.
await page.reload();
await lamp.filter({ hasText: "undecided" }).waitFor();
await conflict.getByRole("button", { name: /^Keep what is here/ }).click();
await until("lamp.awl", "LD I0.5\n= Q0.0\n// mine\n// and this\n// undecided\n");

// Files come and go there as in the page.
await button("New file").click();
await page.getByLabel("Name, with its ending").fill("parts/pump.awl");
await button("Create").click();
await until("parts/pump.awl", "");
await button("More about parts/pump.awl").click();
await page.getByRole("menuitem", { name: "Delete …" }).click();
await page.getByRole("dialog").getByRole("button", { name: "Delete", exact: true }).click();
for (let tries = 0; (await readdir(file("parts"))).length > 0; tries += 1) {
  assert(tries < 100, "the file stays");
  await sleep(100);
}

// A server that is gone: what is written stays in the browser, and that is said.
process.kill(Number(pid));
await sleep(500);
const before = await text("lamp.awl");
await write("// later\n");
await page.getByRole("alert").filter({ hasText: "The folder is out of reach" }).waitFor();
assert.equal(await text("lamp.awl"), before);
assert.deepEqual(
  errors.filter((error) => !error.includes("WebSocket")),
  [],
);
await browser.close();
console.log("a folder is the project, and nobody's text is lost");

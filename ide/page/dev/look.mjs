// Opens the page in Chromium, takes pictures of it in both themes and three widths, and has
// axe-core look at it. `node dev/look.mjs` writes dev/pictures.
import { mkdir, readFile } from "node:fs/promises";
import { chromium } from "playwright-core";
import { serve } from "./serve.mjs";

const OUT = new URL("./pictures/", import.meta.url).pathname;
const AXE = await readFile(new URL("../node_modules/axe-core/axe.min.js", import.meta.url), "utf8");
const WIDTHS = { 1280: 800, 1024: 768, 390: 844 };
const PANELS = ["Problems", "Watch", "Oscilloscope", "Capture", "Plant", "Tests", "Ladder"];

const server = await serve(0);
const address = `http://127.0.0.1:${server.address().port}/`;
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-background-networking",
    "--disable-sync",
    "--no-first-run",
  ],
});
await mkdir(OUT, { recursive: true });
let breaches = 0;

async function axe(page, where) {
  await page.evaluate(AXE);
  const { violations } = await page.evaluate(() => window.axe.run());
  for (const { id, nodes } of violations)
    for (const node of nodes) {
      breaches += 1;
      console.log(
        `${where}: ${id}: ${node.html.slice(0, 120)} ${node.failureSummary.split("\n").slice(1).join(" ")}`,
      );
    }
}

async function fill(page) {
  await page.getByRole("tab", { name: "Watch" }).click();
  for (const operand of ["PieceThere", "MW3", "GoodCount.cv", "Lower"]) {
    await page.getByLabel("Operand or symbol").fill(operand);
    await page.keyboard.press("Enter");
  }
  await page.getByRole("tab", { name: "Oscilloscope" }).click();
  for (const signal of ["PieceThere", "MW3", "Lower"]) {
    await page
      .getByRole("tabpanel", { name: "Oscilloscope" })
      .getByLabel("Signal", { exact: true })
      .fill(signal);
    await page.keyboard.press("Enter");
  }
  await page.getByRole("tab", { name: "Capture" }).click();
  for (const signal of ["PieceThere", "MW3"]) {
    await page
      .getByRole("tabpanel", { name: "Capture" })
      .getByLabel("Signal", { exact: true })
      .fill(signal);
    await page.keyboard.press("Enter");
  }
  await page.getByRole("button", { name: "Simulate" }).click();
}

/** What is there only at times: forces, mistakes, menus, dialogs, two editors, cursors. */
async function others(page, name) {
  const look = async (what) => {
    await page.waitForTimeout(400);
    await page.screenshot({ path: `${OUT}${name}-${what}.png` });
    await axe(page, `${name} ${what}`);
  };
  await page.getByRole("tab", { name: "Watch" }).click();
  await page.getByRole("button", { name: "Force PieceThere" }).click();
  await look("forced");
  await page.getByRole("button", { name: "Release all" }).click();
  await page.getByRole("tab", { name: "Oscilloscope" }).click();
  await page
    .locator(".u-over")
    .first()
    .click({ position: { x: 60, y: 10 } });
  await page.getByLabel("Trigger", { exact: true }).selectOption("rising");
  await look("cursors");
  await page.getByRole("button", { name: "Project" }).click();
  await look("menu");
  await page.keyboard.press("Escape");
  await page.getByRole("button", { name: "Settings" }).click();
  await look("settings");
  await page.keyboard.press("Escape");
  await page.getByRole("tab", { name: "Problems" }).click();
  await page.getByRole("textbox", { name: "station1.awl" }).focus();
  await page.keyboard.press("Control+End");
  await page.keyboard.type("\nNETWORK 12\nLD I0.0\nTON T5, 20\nA Pie");
  await page.getByText("E0013").first().waitFor();
  await look("mistake");
  await page.keyboard.press("Escape");
  await page.keyboard.press("Control+f");
  await look("find");
}

/** The cursor into the largest network. */
async function toNetwork4(page) {
  await page.getByRole("textbox", { name: "station1.awl" }).focus();
  await page.keyboard.press("Control+Home");
  for (let line = 1; line < 64; line += 1) await page.keyboard.press("ArrowDown");
  await page.getByRole("heading", { name: /NETWORK 4/ }).waitFor();
}

async function look(theme, width, height) {
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: theme });
  // axe-core is put into the page by the browser's own door; the page's policy stays as it is.
  const page = await context.newPage();
  page.on(
    "console",
    (message) => message.type() === "error" && console.log("console:", message.text()),
  );
  page.on("pageerror", (error) => console.log("error:", error.stack));
  await page.goto(`${address}#example=station1`);
  await page.getByRole("button", { name: "Run" }).click();
  await fill(page);
  for (const panel of PANELS) {
    await page.getByRole("tab", { name: panel, exact: true }).click();
    if (panel === "Tests") await page.getByRole("button", { name: "Test all" }).click();
    if (panel === "Ladder") await toNetwork4(page);
    await page.waitForTimeout(700);
    await page.screenshot({
      path: `${OUT}${theme}-${width}-${panel.toLowerCase()}.png`,
      fullPage: width < 800,
    });
    await axe(page, `${theme} ${width} ${panel}`);
  }
  await others(page, `${theme}-${width}`);
  await page.getByRole("button", { name: "Help" }).click();
  await page.screenshot({ path: `${OUT}${theme}-${width}-help.png` });
  await axe(page, `${theme} ${width} help`);
  await context.close();
}

for (const theme of ["light", "dark"])
  for (const [width, height] of Object.entries(WIDTHS)) await look(theme, Number(width), height);
await browser.close();
server.close();
console.log(`${breaches} breaches found by axe-core`);
process.exitCode = breaches > 0 ? 1 : 0;

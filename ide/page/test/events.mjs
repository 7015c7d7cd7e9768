// A block of IEC 61499 in the page, in a real Chromium: its chart, events by mouse and keys, values,
// what is refused, what is taken back, other texts and languages. `node test/events.mjs ADDRESS`.
import assert from "node:assert/strict";
import { deflateSync } from "fflate";
import { controls, open } from "./browser.mjs";

const [, , given] = process.argv;
const { browser, page, errors } = await open({ patience: 60_000 });
const { button, tab, panel } = controls(page);
const chart = panel("Chart");
const key = (name) => page.keyboard.press(name);
const field = (name) => chart.getByRole("textbox", { name, exact: true });
const log = chart.getByRole("log", { name: "What came of it" });
const active = chart.locator(".state.on");
const row = (name) =>
  chart.getByRole("row").filter({ has: page.getByRole("rowheader", { name, exact: true }) });
const shows = (name, value) => row(name).getByText(value, { exact: true }).waitFor();

async function begin(file, fragment) {
  await page.goto("about:blank");
  await page.goto(`${given.replace(/\?.*/, "")}#${fragment}`);
  await page.getByRole("textbox", { name: file }).waitFor();
  await tab("Chart");
}

async function set(name, to) {
  await field(name).fill(to);
  await key("Enter");
}

await begin("tank.fbt", "example=tank-fbt");
await active.filter({ hasText: "START" }).waitFor();
assert.equal(await chart.locator(".state").count(), 2);
assert.equal(await chart.locator(".taken").count(), 0);
await set("Nivel", "10.0");
await set("Nivel_actual", "5.0");
await chart.getByRole("button", { name: "Control", exact: true }).click();
await shows("Potencia", "90.0");
await log.getByText("Control: START -> E12 -> START").waitFor();
assert.equal(await chart.locator(".taken").count(), 2, "there and back");
// With keys, and the focus stays.
await set("Nivel_actual", "10.6");
await page.waitForFunction(() => document.activeElement.getAttribute("data-of") === "Nivel_actual");
await chart.getByRole("button", { name: "Control", exact: true }).focus();
await key("Enter");
await shows("Potencia", "10.0");
await page.waitForFunction(() => document.activeElement.textContent === "Control");
// What is no value is refused, and nothing is done.
await set("Nivel", "high");
await page.getByRole("alert").filter({ hasText: "`high` is no value" }).waitFor();
await page.waitForFunction(
  () => document.querySelector(".event-values [aria-label=Nivel]").value === "10.0",
);
// The last is taken back, and all.
await button("Take the last back").click();
await shows("Potencia", "90.0");
await button("Begin anew").click();
await shows("Potencia", "0.0");
assert.equal(await log.locator("li").count(), 0);

// The ramp stays in no state but its first; its chart is as its file says.
await begin("ramp.fbt", "example=ramp-fbt");
await active.filter({ hasText: "START" }).waitFor();
assert.equal(await chart.locator(".link").count(), 4);
await set("X1", "10.0");
for (const event of ["INIT", "REQ"])
  await chart.getByRole("button", { name: event, exact: true }).click();
await log.getByText("REQ: START -> E3 -> START").waitFor();
// Another text: the same is done with it, and a mistake leads to its line.
const editor = page.getByRole("textbox", { name: "ramp.fbt" });
await editor.focus();
await key("Control+End");
await page.keyboard.type("<");
await chart.locator(".events .obstacle").getByText(/\S/).first().waitFor();
assert.equal(await chart.locator(".state:visible").count(), 0);
await key("Control+Home");
await chart.locator(".events").getByRole("button", { name: "Show the place" }).click();
await page.locator(".cm-activeLine", { hasText: "<" }).waitFor();
await editor.focus();
await key("Control+Z");
await log.getByText("REQ: START -> E3 -> START").waitFor();
// Another file has the charts of steps again.
await page.getByRole("button", { name: "ramp.scn", exact: true }).click();
await chart.getByText("The charts of a file are drawn here").waitFor();

// Arrays are set whole.
const array = (name) => `<VarDeclaration Name="${name}" Type="INT" ArraySize="2"/>`;
const block = `<FBType Name="SWAP"><InterfaceList>
  <EventInputs><Event Name="EI"><With Var="A"/></Event></EventInputs>
  <EventOutputs><Event Name="EO"><With Var="B"/></Event></EventOutputs>
  <InputVars>${array("A")}</InputVars><OutputVars>${array("B")}</OutputVars>
  </InterfaceList><BasicFB><ECC><ECState Name="START"/>
  <ECState Name="S"><ECAction Algorithm="Swap" Output="EO"/></ECState>
  <ECTransition Source="START" Destination="S" Condition="EI"/>
  <ECTransition Source="S" Destination="START" Condition="1"/></ECC>
  <Algorithm Name="Swap"><ST Text="B[0] := A[1]; B[1] := A[0];"/></Algorithm></BasicFB></FBType>`;
const content = JSON.stringify({ files: [{ name: "swap.fbt", text: block }] });
const packed = Buffer.from(deflateSync(Buffer.from(content))).toString("base64url");
await begin("swap.fbt", `project=${packed}`);
await set("A", "[3, 4]");
await chart.getByRole("button", { name: "EI", exact: true }).click();
await shows("B", "[4, 3]");
await set("A", "[3]");
await page.getByRole("alert").filter({ hasText: "A is an array of 2" }).waitFor();
assert.deepEqual(errors, []);
await browser.close();
console.log("a block of IEC 61499: events, values, mistakes");

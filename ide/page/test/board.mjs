// A board at a port, in a real Chromium: a new Uno with the real bootloader at the bridge gets
// firmware and program, answers, and gets another program by Web Serial, whose port leads to the same
// board. `node test/board.mjs ADDRESS PORT`; the address has a token, the port is known to the bridge.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { controls, open } from "./browser.mjs";

const [, , address, port] = process.argv;
const { browser, page, errors } = await open({ patience: 120_000 });

const { button, mode, tab, panel } = controls(page);
const dialog = (name) => page.getByRole("dialog", { name });
const agree = (name, words) =>
  dialog(name).getByRole("button", { name: words, exact: true }).click();

/** Web Serial whose only port is the bridge's: what it is asked for goes through a WebSocket. */
await page.addInitScript((name) => {
  class FakePort {
    readable = null;
    writable = null;
    async open({ baudRate, parity }) {
      const socket = new WebSocket(`ws://${location.host}/bridge`);
      socket.binaryType = "arraybuffer";
      await new Promise((opened) => (socket.onopen = opened));
      this.socket = socket;
      const waiting = [];
      let stream;
      socket.onmessage = ({ data }) => {
        // As at a real port, what comes after the reader has gone is lost.
        if (typeof data !== "string") return stream?.enqueue(new Uint8Array(data));
        waiting.shift()?.(JSON.parse(data));
      };
      this.ask = (wish) =>
        new Promise((told) => {
          waiting.push(told);
          socket.send(JSON.stringify(wish));
        });
      await this.ask({ do: "hello", session: sessionStorage.getItem("bridge") });
      const told = await this.ask({ do: "open", name, baud: baudRate, parity });
      if (told.is !== "done") throw new DOMException(told.message, "NetworkError");
      this.readable = new ReadableStream({
        start: (controller) => (stream = controller),
        cancel: () => (stream = undefined),
      });
      this.writable = new WritableStream({ write: (bytes) => socket.send(bytes) });
    }
    async setSignals({ dataTerminalReady }) {
      await this.ask({ do: "lines", on: dataTerminalReady });
    }
    async close() {
      await this.ask({ do: "close" });
      this.socket.close();
      this.readable = this.writable = null;
    }
  }
  const serial = { requestPort: async () => new FakePort() };
  Object.defineProperty(navigator, "serial", { value: serial });
}, port);

await page.goto(`${address}#example=motor`);
const editor = page.getByRole("textbox", { name: "motor.awl" });
await editor.waitFor();
assert.ok(!page.url().includes("token"), "the token stays in the address");

// A new board: its bootloader and nothing else.
await page.getByRole("combobox", { name: "Target" }).selectOption("Bridge");
await button("Download").click();
await dialog("Choose a port").getByLabel("Port").selectOption(port);
await agree("Choose a port", "Go on");
await agree("Other firmware", "Write both");
await mode("LOADING");
await mode("writing");
await mode("reading back");
await mode("RUN");

// Inputs are forced, four signals plotted; a recording has what the motor does when it is stopped.
const SIGNALS = ["Forward", "RunForward", "Coasting", "Coasting.cv"];
await tab("Watch");
for (const input of ["StopOk", "ProtectionOk", "Forward"]) {
  await page.getByLabel("Operand or symbol").fill(input);
  await page.keyboard.press("Enter");
  await page.getByLabel(`New value of ${input}`).fill("1");
  await button(`Force ${input}`).click();
}
const cell = (operand, value) =>
  panel("Watch")
    .getByRole("row")
    .filter({ hasText: operand })
    .getByRole("cell", { name: value, exact: true })
    .waitFor();
await page.getByLabel("Operand or symbol").fill("RunForward");
await page.keyboard.press("Enter");
await cell("RunForward", "1");
for (const name of ["Oscilloscope", "Capture"]) {
  await tab(name);
  for (const signal of SIGNALS) {
    await panel(name).getByLabel("Signal", { exact: true }).fill(signal);
    await page.keyboard.press("Enter");
  }
}
await tab("Oscilloscope");
await panel("Oscilloscope").locator(".uplot").nth(3).waitFor();
await tab("Capture");
await panel("Capture").getByLabel("Seconds", { exact: true }).fill("3");
await panel("Capture").getByLabel("Step in ms", { exact: true }).fill("20");
await button("Record").click();
await panel("Capture")
  .getByText(/Recording: [1-9.]+ of 3 s/)
  .waitFor();
await tab("Watch");
for (const input of ["Forward", "StopOk"]) {
  await page.getByLabel(`New value of ${input}`).fill("0");
  await button(`Force ${input}`).click();
}
await cell("RunForward", "0");
await tab("Capture");
await panel("Capture").getByText("s of the target recorded").waitFor();
const download = page.waitForEvent("download");
await button("Save CSV").click();
const csv = await readFile(await (await download).path(), "utf8");
const [head, ...rows] = csv.trim().split("\n");
assert.equal(head, "time_ms,scan,Forward,RunForward,Coasting,Coasting.cv");
const table = rows.map((row) => row.split(",").map(Number));
assert(table.length > 20, csv);
const drops = table.findIndex((row) => row[3] === 0);
assert(drops > 0, csv);
for (const [index, [time, scan, , runs, coasts, counted]] of table.entries()) {
  const before = table[index - 1];
  if (before) assert(time > before[0] && scan > before[1], csv);
  assert.equal(runs, index < drops ? 1 : 0, csv);
  assert.equal(coasts, 1, csv);
  // The time of coming to rest, in tenths of a second since the contactor dropped.
  const since = runs ? 0 : (time - table[drops][0]) / 100;
  assert(Math.abs(counted - since) < 2.5, `${counted} after ${since}: ${csv}`);
}
await tab("Watch");
await button("Release all").click();
await cell("RunForward", "0");

// It survives a reload, in which the token is gone.
await button("Connect").click();
await mode("OFFLINE");
await page.reload();
await editor.waitFor();
await page.getByRole("combobox", { name: "Target" }).selectOption("Bridge");
await button("Connect").click();
await agree("Choose a port", "Go on");
await mode("RUN");
await button("Stop").click();
await mode("STOP");
await button("Connect").click();
await mode("OFFLINE");

// Another program by Web Serial. The firmware is there, so nobody is asked for it.
await editor.click();
await page.keyboard.press("Control+End");
await page.keyboard.type("\nLD SM0.0\n= Q0.4\n");
await page.getByRole("combobox", { name: "Target" }).selectOption("Uno on USB");
await button("Run").click();
await agree("Choose a port", "Go on");
await mode("LOADING");
await mode("RUN");
await page.getByRole("tab", { name: "Watch", exact: true }).click();
await page.getByLabel("Operand or symbol").fill("Q0.4");
await page.keyboard.press("Enter");
const watch = page.getByRole("tabpanel", { name: "Watch" });
await watch.getByRole("cell", { name: "1", exact: true }).first().waitFor();
await button("Connect").click();
await mode("OFFLINE");
assert.deepEqual(errors, []);
await browser.close();
console.log("the page writes a board");

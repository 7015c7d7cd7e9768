// Every error that the page can tell, provoked in a real Chromium: what somebody reads then.
// `node test/errors.mjs UNO200 FOLDER`: the tool, and the folder that a page is served from.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { readdir, readFile } from "node:fs/promises";
import { createServer } from "node:net";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { deflateSync, zipSync } from "fflate";
import { open } from "./browser.mjs";
import { loadSource } from "./load.mjs";

const [, , uno200, folder] = process.argv;
const { TABLE } = await loadSource("src/text/table.ts");

/** What tells that something is wrong or cannot be done, and is not in a `notice(…, true)`. */
const OTHERS = ["fault", "linkLost", "otherProgram", "leaveForced", "noDefinition", "noReferences"];
const MORE = ["nothingToRename", "noValueHere", "portGone", "bridgeGone", "samplesLost"];
/** Told with a board, a folder, or several files: test/board.mjs, folder.mjs, reload.mjs. */
const ELSEWHERE = [
  ...["otherFirmware", "writeFirmware"],
  ...["notSaved", "filesLeftOut", "folderOutOfReach"],
  ...["undoElsewhere", "redoElsewhere"],
];

/** All of them, as the sources have them. */
async function catalogue() {
  const keys = new Set([...OTHERS, ...MORE]);
  const files = (await readdir("src", { recursive: true })).filter((name) => name.endsWith(".ts"));
  for (const name of files) {
    const text = await readFile(join("src", name), "utf8");
    for (const [, given] of text.matchAll(/notice\(((?:(?!notice\()[^;])*?),\s*true,?\s*\)/g))
      for (const [, key] of given.matchAll(/"(\w+)"/g)) keys.add(key);
    for (const [, key] of text.matchAll(/new Error\(t\("(\w+)"/g)) keys.add(key);
  }
  for (const key of Object.keys(TABLE))
    if (/^unfit/.test(key) || key === "linkTooLong") keys.add(key);
  return [...keys].filter((key) => key in TABLE && !ELSEWHERE.includes(key));
}

/** What was read. */
const seen = new Set();

/** The words of a message, whatever stands in its places. */
function words(key) {
  const parts = TABLE[key][0]
    .split(/\{\d\}/)
    .map((part) => part.replace(/[.*+?^${}()|[\]\\]/g, "\\$&"));
  return new RegExp(parts.join("[^]*"));
}

/** Waits until a message can be read. */
async function said(page, key) {
  await page.getByText(words(key)).first().waitFor();
  seen.add(key);
}

/** A server with its address; `end` ends it. */
async function serve(...more) {
  const given = ["ide", "--no-open", "--listen", "127.0.0.1:0", "--page", folder, ...more];
  const child = spawn(uno200, given, { stdio: ["ignore", "pipe", "inherit"] });
  const [address] = await once(createInterface({ input: child.stdout }), "line");
  const end = async () => {
    child.kill();
    await once(child, "exit");
  };
  return { address, plain: address.replace(/\?.*/, ""), end };
}

const { browser, errors } = await open();
const server = await serve();

/**
 * A page of a browser that knows nothing yet; what is done in it. Without the service worker, which
 * would give files that a situation keeps away.
 */
async function situation(address, act, prepare = async () => {}) {
  const viewport = { width: 1280, height: 800 };
  const context = await browser.newContext({ viewport, serviceWorkers: "block" });
  const page = await context.newPage();
  page.setDefaultTimeout(60_000);
  page.on("pageerror", (error) => errors.push(error.message));
  await prepare(page, context);
  await page.goto(address);
  await act(page, context);
  await context.close();
}

const button = (page, name) => page.getByRole("button", { name, exact: true });
const editor = (page) => page.getByRole("textbox", { name: "blink.awl" });
const status = (page, text) => page.getByRole("status").first().filter({ hasText: text }).waitFor();
const target = (page, label) =>
  page.getByRole("combobox", { name: "Target" }).selectOption({ label });

async function choose(page, item) {
  await button(page, "Project").click();
  await page.getByRole("menuitem", { name: item }).click();
}

/** Puts a text in the place of the one that is there. */
async function write(page, text) {
  await editor(page).click();
  await page.keyboard.press("Control+a");
  await page.keyboard.insertText(text);
}

/** Gives the page a file when it asks for one. */
async function give(page, name, bytes) {
  const asked = page.waitForEvent("filechooser");
  await choose(page, "Open files or .zip …");
  const buffer = Buffer.from(bytes);
  await (await asked).setFiles({ name, mimeType: "application/octet-stream", buffer });
}

const link = (content) => {
  const text = typeof content === "string" ? content : JSON.stringify(content);
  return `#project=${Buffer.from(deflateSync(Buffer.from(text))).toString("base64url")}`;
};
const file = (name, text = "LD I0.0\n") => ({ name, text });
const many = (count) => Array.from({ length: count }, (_, number) => file(`a${number}.awl`));

// Projects of others: a link.
for (const [key, fragment] of [
  ["unfitBroken", "#project=@@@"],
  ["unfitBroken", link({ files: [file("lamp.awl")] }).slice(0, -9)],
  ["unfitBroken", link({ files: [{ name: 7 }] })],
  // A few thousand letters that would become five megabytes.
  ["unfitBroken", link(" ".repeat(5_000_000))],
  ["unfitEmpty", link({ files: [] })],
  ["unfitName", link({ files: [file("../lamp.awl")] })],
  ["unfitName", link({ files: [file("lamp.html")] })],
  ["unfitTooMany", link({ files: many(201) })],
  ["unfitEmpty", "#example=nothing"],
  ["unfitName", "#example=../list"],
])
  await situation(server.plain + fragment, async (page) => {
    await said(page, key);
    // What was there before is open.
    await editor(page).waitFor();
  });

// What they hold is text, whatever it looks like, and nothing runs by itself.
const script = "<img src=x onerror=alert(1)><script>alert(2)</script>";
const foreign = { files: [file("blink.awl", `// ${script}\nLD ${script}\n`)], plant: script };
await situation(server.plain + link(foreign), async (page) => {
  await editor(page).filter({ hasText: "onerror" }).waitFor();
  assert.equal(await page.locator("img, script:not([src])").count(), 0);
  await status(page, "OFFLINE");
});

// Files and .zip of others; names in the project.
await situation(server.plain, async (page) => {
  await editor(page).waitFor();
  await give(page, "a.zip", [1, 2, 3]);
  await said(page, "unfitBroken");
  await give(page, "b.zip", zipSync({ "a.awl": new Uint8Array(4_000_001) }));
  await said(page, "unfitTooLarge");
  const entries = many(201).map(({ name }) => [name, new Uint8Array(1)]);
  await give(page, "c.zip", zipSync(Object.fromEntries(entries)));
  await said(page, "unfitTooMany");
  await give(page, "d.zip", zipSync({ "picture.png": new Uint8Array(9) }));
  await said(page, "unfitEmpty");
  await give(page, "virus.exe", [1, 2, 3]);
  await said(page, "unfitName");
  await give(page, "e.awl", new Uint8Array(4_000_001));
  await said(page, "unfitTooLarge");
  for (const [name, key] of [
    ["blink.awl", "unfitExists"],
    ["../blink.awl", "unfitName"],
  ]) {
    await button(page, "New file").click();
    await page.getByLabel("Name, with its ending").fill(name);
    await button(page, "Create").click();
    await said(page, key);
  }
  const letters = Array.from({ length: 60_000 }, (_, at) =>
    (Math.imul(at, 48271) >>> 7).toString(36),
  );
  await write(page, `// ${letters.join("")}\n`);
  await choose(page, "Copy a link to it");
  await said(page, "linkTooLong");
});

// The editor has nothing to go to.
await situation(server.plain, async (page) => {
  await write(page, "\n\n");
  await page.keyboard.press("F12");
  await said(page, "noDefinition");
  await page.keyboard.press("Shift+F12");
  await said(page, "noReferences");
  await page.keyboard.press("F2");
  await said(page, "nothingToRename");
  await page.keyboard.press("Alt+Enter");
  await said(page, "noValueHere");
});

// The browser's storage.
const fill = () => {
  localStorage.clear();
  let size = 4_000_000;
  while (size > 0)
    try {
      localStorage.setItem(`filled${localStorage.length}`, "x".repeat(size));
    } catch {
      size >>= 1;
    }
};
await situation(
  server.plain,
  async (page) => {
    await write(page, "LD I0.1\n= Q0.0\n");
    await said(page, "storageFull");
    await status(page, "OFFLINE");
    await button(page, "Run").click();
    await status(page, "RUN");
  },
  (page) => page.addInitScript(fill),
);
await situation(server.plain, async (page, context) => {
  await editor(page).waitFor();
  const other = await context.newPage();
  await other.goto(server.plain);
  await said(other, "openElsewhere");
  await write(other, "LD I0.5\n");
  assert(!(await editor(page).innerText()).includes("I0.5"));
});

// A core that cannot be loaded.
await situation(
  server.plain,
  (page) => said(page, "coreBroken"),
  (page) => page.route(/ide_core_bg\.wasm/, (route) => route.abort()),
);

// A program that goes wrong, and one that is not the one on the screen; forces when leaving.
await situation(server.plain, async (page) => {
  await write(page, "NETWORK 1\nLBL 1\nLD SM0.0\nJMP 1\n");
  await button(page, "Run").click();
  await said(page, "fault");
  await write(page, "NETWORK 1\nLD I0.0\n= Q0.0\n");
  await button(page, "Run").click();
  await status(page, "RUN");
  await write(page, "NETWORK 1\nLD I0.1\n= Q0.0\n");
  await said(page, "otherProgram");
  await button(page, "Run").click();
  await page.getByRole("tab", { name: "Watch", exact: true }).click();
  await page.getByLabel("Operand or symbol").fill("I0.1");
  await page.keyboard.press("Enter");
  await page.getByLabel("New value of I0.1").fill("1");
  await button(page, "Force I0.1").click();
  await page.getByRole("cell", { name: "1", exact: true }).first().waitFor();
  await choose(page, "New project");
  await button(page, "Create").click();
  await said(page, "leaveForced");
});

// Samples that could not be taken: how the core finds that its own tests ask.
await situation(
  server.plain,
  async (page) => {
    await editor(page).waitFor();
    await page.getByRole("tab", { name: "Oscilloscope", exact: true }).click();
    const scope = page.getByRole("tabpanel", { name: "Oscilloscope" });
    await scope.getByLabel("Signal", { exact: true }).fill("Q0.0");
    await page.keyboard.press("Enter");
    await page.evaluate(() => {
      const samples = (times, lost) => ({ is: "samples", times, columns: [[0, 1]], lost });
      const data = [samples([1, 2], false), samples([500, 501], true)];
      globalThis.core.onmessage({ data });
    });
    await said(page, "samplesLost");
  },
  (page) =>
    page.addInitScript(() => {
      const Real = Worker;
      globalThis.Worker = class extends Real {
        constructor(...given) {
          super(...given);
          globalThis.core = this;
        }
      };
    }),
);

// A picture that the browser does not make.
await situation(
  server.plain,
  async (page) => {
    await editor(page).waitFor();
    await page.getByRole("tab", { name: "Capture", exact: true }).click();
    await page
      .getByRole("tabpanel", { name: "Capture" })
      .getByLabel("Signal", { exact: true })
      .fill("Q0.0");
    await page.keyboard.press("Enter");
    await button(page, "Simulate").click();
    await button(page, "Save PNG").click();
    await said(page, "noPicture");
  },
  (page) => page.addInitScript(() => (HTMLCanvasElement.prototype.toBlob = (taken) => taken(null))),
);

// Ways outside that are not there.
await situation(
  server.plain,
  async (page) => {
    await editor(page).waitFor();
    await target(page, "Uno on USB");
    await button(page, "Connect").click();
    await said(page, "noWebSerial");
    await target(page, "Bridge");
    await button(page, "Connect").click();
    await said(page, "noBridge");
  },
  (page) => page.addInitScript(() => delete Navigator.prototype.serial),
);
const noPorts = (page) =>
  page.routeWebSocket(/\/bridge$/, (socket) =>
    socket.onMessage((message) => {
      const isHello = JSON.parse(message).do === "hello";
      const told = isHello
        ? { is: "welcome", session: "s", folder: false }
        : { is: "ports", ports: [] };
      socket.send(JSON.stringify(told));
    }),
  );
await situation(
  server.address,
  async (page) => {
    await editor(page).waitFor();
    await target(page, "Bridge");
    await button(page, "Connect").click();
    await said(page, "noPorts");
  },
  noPorts,
);

// What explains an error is a file that does not come.
await situation(
  server.address,
  async (page) => {
    await write(page, "LD I9.9\n");
    await page.getByRole("tab", { name: "Problems", exact: true }).click();
    await page
      .getByRole("button", { name: /^E\d{4}$/ })
      .first()
      .click();
    await said(page, "noExplanation");
  },
  (page) => page.route(/errors\/E\d+\.md/, (route) => route.abort()),
);

// What draws does not come either.
await situation(
  `${server.plain}#example=mixing-sfc`,
  async (page) => {
    await page.getByRole("tab", { name: "Chart", exact: true }).click();
    await said(page, "drawingBroken");
  },
  (page) => page.route(/drawings\.js$/, (route) => route.abort()),
);

// A PLC on the network that does not answer; its port in use; the bridge that is gone.
const dumb = createServer(() => {});
await new Promise((listening) => dumb.listen(0, "127.0.0.1", listening));
const bridge = await serve("--tcp", `127.0.0.1:${dumb.address().port}`);
const connect = async (page) => {
  await editor(page).waitFor();
  await target(page, "Bridge");
  await button(page, "Connect").click();
  await button(page, "Go on").click();
};
await situation(bridge.address, async (page, context) => {
  await connect(page);
  await said(page, "linkLost");
  // The key of the session is the tab's; a tab that it opens has it, too.
  const [other] = await Promise.all([
    context.waitForEvent("page"),
    page.evaluate(() => window.open(location.pathname)),
  ]);
  other.setDefaultTimeout(60_000);
  await connect(other);
  await other
    .getByText(/in use by another page: disconnect there first/)
    .first()
    .waitFor();
  await bridge.end();
  await said(page, "portGone");
  await button(page, "Connect").click();
  await said(page, "bridgeGone");
});
dumb.close();
await server.end();

const missing = (await catalogue()).filter((key) => !seen.has(key));
console.log(`${seen.size} errors provoked`);
assert.deepEqual(missing, [], "never provoked");
assert.deepEqual(errors, []);
await browser.close();

// The page without its server, in a real Chromium: once opened it opens again, from any web server
// that gives the files away; another version is taken whole at the next load. `node test/offline.mjs
// FOLDER`; in the folder is what is served.
import assert from "node:assert/strict";
import { createServer } from "node:http";
import { readFile, readdir } from "node:fs/promises";
import { extname, join, relative } from "node:path";
import { open } from "./browser.mjs";

const [, , folder] = process.argv;
const TYPES = {
  ".html": "text/html; charset=utf-8",
  ".wasm": "application/wasm",
  ".css": "text/css",
};
/** As uno200/src/ide/page.rs has it. */
const POLICY =
  "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; " +
  "img-src 'self' data: blob:; connect-src 'self'; worker-src 'self'; object-src 'none'; " +
  "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/** The files of a version, by their addresses. */
async function read(folder) {
  const entries = await readdir(folder, { recursive: true, withFileTypes: true });
  const paths = entries
    .filter((entry) => entry.isFile())
    .map((entry) => join(entry.parentPath, entry.name));
  const files = paths.map(async (path) => [`/${relative(folder, path)}`, await readFile(path)]);
  return new Map(await Promise.all(files));
}

/** The same with another script, in a folder with another name. */
function changed(files, name) {
  const version = versionOf(files);
  const other = [...files].map(([path, bytes]) => {
    const named = ["/index.html", "/sw.js"].includes(path) || path.endsWith("/files.json");
    const text = named && Buffer.from(bytes.toString().replaceAll(version, name));
    const isScript = path.endsWith("/page.js");
    const script = isScript && Buffer.concat([Buffer.from(`globalThis.seen = "${name}";`), bytes]);
    return [path.replace(version, name), script || text || bytes];
  });
  return new Map(other);
}

function versionOf(files) {
  return [...files.keys()].find((path) => path.endsWith("/page.js")).split("/")[1];
}

/** A web server that knows nothing. */
async function serve(files, port) {
  const server = createServer((request, response) => {
    const path = new URL(request.url, "http://localhost").pathname;
    const file = path === "/" ? "/index.html" : path;
    const bytes = files.get(file);
    const type = TYPES[extname(file)] ?? "text/javascript";
    response.writeHead(bytes ? 200 : 404, {
      "Content-Type": type,
      "Content-Security-Policy": POLICY,
    });
    response.end(bytes);
  });
  await new Promise((resolve) => server.listen(port, "127.0.0.1", resolve));
  return {
    port: server.address().port,
    end: () => new Promise((ended) => (server.closeAllConnections(), server.close(ended))),
  };
}

const { browser, page, errors } = await open();
const editor = (name) => page.getByRole("textbox", { name });

/** Waits until this version is the one that the browser keeps. */
async function isKept(version) {
  const look = async (version) => {
    const { installing, waiting, active } = (await navigator.serviceWorker.getRegistration()) ?? {};
    if (installing || waiting || active?.state !== "activated") return false;
    const name = (await caches.keys()).find((name) => name.includes(version));
    return name !== undefined && (await (await caches.open(name)).match("./")) !== undefined;
  };
  for (let tries = 0; !(await page.evaluate(look, version)); tries += 1) {
    assert(tries < 300, `${version} is not kept`);
    await page.waitForTimeout(100);
  }
}

/** Opens the page again: everything in it is of one version, and it works. */
async function works(version) {
  await page.reload();
  await editor("station1.awl").waitFor();
  const loaded = await page.evaluate(() =>
    [...performance.getEntriesByType("resource")].map(({ name }) => new URL(name).pathname),
  );
  const inner = loaded.filter((path) => path !== "/sw.js");
  assert(inner.length > 1 && inner.every((path) => path.startsWith(`/${version}/`)), `${inner}`);
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await page.getByRole("status").first().filter({ hasText: "RUN" }).waitFor();
  await page.getByRole("button", { name: "Stop", exact: true }).click();
}

const first = await read(folder);
let server = await serve(first, 0);
const { port } = server;
await page.goto(`http://127.0.0.1:${port}/#example=station1`);
await editor("station1.awl").waitFor();
await isKept(versionOf(first));
await server.end();
await works(versionOf(first));
// An example that was never looked at before.
await page.goto("about:blank");
await page.goto(`http://127.0.0.1:${port}/?anything#example=tank`);
await editor("tank.awl").waitFor();
// Neither was what explains an error.
await editor("tank.awl").focus();
await page.keyboard.press("Control+End");
await page.keyboard.type("\nLD I9.9\n");
await page.getByRole("tab", { name: "Problems", exact: true }).click();
await page
  .getByRole("button", { name: /^E\d{4}$/ })
  .first()
  .click();
await page.getByRole("dialog").getByText("Wrong:").waitFor();
await page.goto(`http://127.0.0.1:${port}/#example=station1`);

// Another version comes with the next load, and is kept in place of the first.
server = await serve(changed(first, "second"), port);
await works("second");
await isKept("second");
await server.end();
await works("second");
assert.equal(await page.evaluate(() => globalThis.seen), "second");

// One that does not come whole is not kept.
const broken = changed(first, "third");
broken.delete("/third/worker.js");
server = await serve(broken, port);
await page.reload();
await page.waitForFunction(() => globalThis.seen === "third");
await page.evaluate(async () => (await navigator.serviceWorker.getRegistration()).update());
await page.waitForTimeout(2000);
await server.end();
await works("second");

// That a server is away, or lacks a file, the browser notes by itself.
const others = errors.filter((error) => !/Failed to load resource|ERR_CONNECTION/.test(error));
assert.deepEqual(
  others.filter((error) => !/does not work any more|worker/i.test(error)),
  [],
);
await browser.close();
console.log("the page opens without its server, and versions are not mixed");

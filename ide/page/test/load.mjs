// Loads the core and parts of the page into node, without a browser.
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { build } from "esbuild";

/** A module, given as a text. */
async function load(text) {
  const folder = await mkdtemp(join(tmpdir(), "uno200-"));
  try {
    const file = join(folder, "module.mjs");
    await writeFile(file, text);
    return await import(pathToFileURL(file));
  } finally {
    await rm(folder, { recursive: true });
  }
}

/** Where everything is that belongs to a version, in the folder that a page is served from. */
export async function innerFolder(folder) {
  const page = await readFile(join(folder, "index.html"), "utf8");
  return join(folder, /"(\w+)\/page\.js"/.exec(page)[1]);
}

/** The core, in the folder of its version. */
export async function loadCore(folder) {
  const core = await load(await readFile(join(folder, "ide_core.js"), "utf8"));
  await core.default({ module_or_path: await readFile(join(folder, "ide_core_bg.wasm")) });
  return core;
}

/** What esbuild makes of sources, as one text. */
export async function bundled(options) {
  const { outputFiles } = await build({
    bundle: true,
    write: false,
    logLevel: "warning",
    ...options,
  });
  return outputFiles[0].text;
}

/** A source of the page with all that it imports. */
export async function loadSource(path) {
  return load(await bundled({ format: "esm", entryPoints: [path] }));
}

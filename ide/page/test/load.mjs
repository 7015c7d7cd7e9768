// Loads the core and parts of the page into node, without a browser.
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { build } from "esbuild";

const load = (text) =>
  import(`data:text/javascript;base64,${Buffer.from(text).toString("base64")}`);

/** The core of the folder that a page is served from. */
export async function loadCore(folder) {
  const core = await load(await readFile(join(folder, "ide_core.js"), "utf8"));
  await core.default({ module_or_path: await readFile(join(folder, "ide_core_bg.wasm")) });
  return core;
}

/** A source of the page with all that it imports. */
export async function loadSource(path) {
  const options = { bundle: true, format: "esm", write: false, logLevel: "warning" };
  const { outputFiles } = await build({ ...options, entryPoints: [path] });
  return load(outputFiles[0].text);
}

// Builds dist: bundles the page and its worker, copies what needs no bundling. The same sources
// give the same bytes.
import { build } from "esbuild";
import { mkdir, readFile, readdir, rm, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { writeMnemonics } from "./mnemonics.mjs";

const OUT = "dist";
/** Everything that belongs together; where the page is served its name is that of a version. */
const VERSION = join(OUT, "version");

const options = {
  bundle: true,
  format: "esm",
  target: "es2022",
  minify: true,
  charset: "utf8",
  legalComments: "none",
  metafile: true,
  logLevel: "warning",
};

await writeMnemonics();
await rm(OUT, { recursive: true, force: true });
await mkdir(VERSION, { recursive: true });
const page = await build({
  ...options,
  entryPoints: { page: "src/page.ts" },
  outdir: VERSION,
  // What is not needed at first comes in a file of its own.
  splitting: true,
  // Styles of the editor come from a sheet that the Content-Security-Policy allows.
  alias: { "style-mod": "./src/editor/style-mod.ts" },
});
// The core is beside the worker: `ide_core.js` and `ide_core_bg.wasm`, by wasm-bindgen.
const worker = await build({
  ...options,
  entryPoints: { worker: "src/core/worker.ts" },
  outdir: VERSION,
  external: ["./ide_core.js"],
});
// So is the module of drawings: `ide_drawings.js` and `ide_drawings_bg.wasm`.
await build({
  ...options,
  entryPoints: { drawings: "src/drawings/worker.ts" },
  outdir: VERSION,
  external: ["./ide_drawings.js"],
});
// Its address is the same for all versions, and what it keeps is below it.
await build({
  ...options,
  entryPoints: { sw: "src/offline/service_worker.ts" },
  outdir: OUT,
  format: "iife",
});
await writeFile(join(OUT, "index.html"), await readFile("index.html"));
await writeFile(join(VERSION, "licences.txt"), await licences([page, worker]));

/** The licences of what is in the bundles, in the order of the names of the packages. */
async function licences(bundles) {
  const inputs = bundles.flatMap(({ metafile }) => Object.keys(metafile.inputs));
  const name = (path) => /^node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(path)?.[1];
  const packages = [...new Set(inputs.map(name).filter(Boolean))].sort();
  const texts = packages.map(async (name) => {
    const folder = join("node_modules", name);
    const { version } = JSON.parse(await readFile(join(folder, "package.json"), "utf8"));
    const file = (await readdir(folder)).find((file) => /^licen[cs]e/i.test(file));
    if (!file) throw new Error(`${name} has no licence file`);
    return `${name} ${version}\n\n${(await readFile(join(folder, file), "utf8")).trim()}\n`;
  });
  return (await Promise.all(texts)).join("\n----\n\n");
}

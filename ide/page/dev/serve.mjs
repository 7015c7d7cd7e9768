// A server for trials: dist, the examples of this repository, and a pretended core unless the real
// one is in target/ide. Not the product's server.
import { createServer } from "node:http";
import { readFile, readdir } from "node:fs/promises";
import { fileURLToPath } from "node:url";

const at = (path) => fileURLToPath(new URL(path, import.meta.url));
const TYPES = {
  html: "text/html; charset=utf-8",
  js: "text/javascript",
  css: "text/css",
  wasm: "application/wasm",
  json: "application/json",
};
const POLICY =
  "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; " +
  "connect-src 'self' ws:; img-src 'self' data: blob:";
const EXAMPLES = at("../../../examples/");
const PLANTS = { station1: "station1", tank: "tank" };

/** The examples in other languages than AWL have a mark at their names. */
const MARK = /-(st|sfc|fbt)$/;

async function example(name) {
  const stem = name.replace(MARK, "");
  const ending = MARK.exec(name)?.[1] ?? "awl";
  const folder = ending === "awl" ? "" : `${ending}/`;
  const described = `${stem}.plant`;
  const isIts = (file) => file === `${stem}.scn` || file === described;
  const own = (await readdir(EXAMPLES + folder)).filter(isIts).map((file) => folder + file);
  const beside = own.length > 0 ? own : (await readdir(EXAMPLES)).filter(isIts);
  const read = async (path) => ({
    name: path.split("/").pop(),
    text: await readFile(EXAMPLES + path, "utf8"),
  });
  const files = await Promise.all([`${folder}${stem}.${ending}`, ...beside].map(read));
  const isSame = folder === "" || own.length === 0;
  const plant = (isSame && PLANTS[stem]) || (beside.includes(described) ? described : null);
  return JSON.stringify({
    files,
    main: `${stem}.${ending}`,
    plant,
    view: plant ? "plant" : "problems",
  });
}

async function exampleNames() {
  const named = async (folder, ending, mark) =>
    (await readdir(EXAMPLES + folder))
      .filter((file) => file.endsWith(ending))
      .map((file) => file.replace(ending, mark));
  const others = ["st", "sfc", "fbt"].map((one) => named(one, `.${one}`, `-${one}`));
  return JSON.stringify([...(await named("", ".awl", "")), ...(await Promise.all(others)).flat()]);
}

async function answer(path) {
  if (path === "/version/examples/list.json") return exampleNames();
  const name = /^\/version\/examples\/([\w-]+)\.json$/.exec(path)?.[1];
  if (name) return example(name);
  const code = /^\/version\/errors\/(\w+\.md)$/.exec(path)?.[1];
  if (code) return readFile(at(`../../../docs/errors/${code}`));
  const file = path === "/" ? "/index.html" : path;
  if (/^\/version\/ide_/.test(file)) {
    const real = at(`../../../target/ide-core/${file.slice("/version/".length)}`);
    return readFile(real).catch(() => readFile(at("./fake_core.js")));
  }
  if (!/^\/(version\/)?[\w.-]+$/.test(file)) throw new Error("no such file");
  return readFile(at(`../dist${file}`));
}

/** Serves at a port; 0 takes a free one. */
export function serve(port) {
  const server = createServer(async (request, response) => {
    const path = new URL(request.url, "http://localhost").pathname;
    try {
      const body = await answer(path);
      const ending = path === "/" ? "html" : path.split(".").pop();
      const headers = { "Content-Type": TYPES[ending] ?? "text/plain" };
      response.writeHead(200, { ...headers, "Content-Security-Policy": POLICY }).end(body);
    } catch {
      response.writeHead(404).end();
    }
  });
  return new Promise((resolve) => server.listen(port, "127.0.0.1", () => resolve(server)));
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const server = await serve(Number(process.argv[2] ?? 8201));
  console.log(`http://127.0.0.1:${server.address().port}/`);
}

// The core as WebAssembly is told what it was told in tests on this computer, call by call, and must
// answer the same. `node test/log.mjs CORE LOG`: the folders of the core, and of what the tests have
// written (ide/core/tests/recorded).
import assert from "node:assert/strict";
import { readdir, readFile } from "node:fs/promises";
import { join } from "node:path";
import { loadCore } from "./load.mjs";

const [, , core, log] = process.argv;
/** Fewer are not what the tests write. */
const TESTS_MIN = 15;

const { Ide } = await loadCore(core);
let calls = 0;
const files = (await readdir(log)).filter((name) => name.endsWith(".jsonl"));
assert(files.length >= TESTS_MIN, `${files.length} logs in ${log}`);
for (const name of files) {
  const ide = new Ide();
  const lines = (await readFile(join(log, name), "utf8")).split("\n").filter(Boolean);
  for (const [index, line] of lines.entries()) {
    const { call, arguments: given, answer } = JSON.parse(line);
    const [first, ...others] = given;
    const told = ide[call](Array.isArray(first) ? Uint8Array.from(first) : first, ...others);
    if (told !== answer)
      assert.deepEqual(JSON.parse(told), JSON.parse(answer), `${name}:${index + 1}`);
    assert.equal(told, answer, `${name}:${index + 1}`);
  }
  calls += lines.length;
}
console.log(`${calls} calls in ${files.length} logs: the same answers as WebAssembly`);

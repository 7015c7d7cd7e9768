// Writes src/editor/mnemonics.ts from docs/instructions.md, which comes from the instruction table.
import { readFile, writeFile } from "node:fs/promises";

const SOURCE = "../../docs/instructions.md";
const TARGET = "src/editor/mnemonics.ts";
const RELATIONS = ["=", "<>", "<", "<=", ">", ">="];

/** The mnemonics of a row: its own and its other names. */
function names(row) {
  const cells = row.split("|").slice(1, 3).join(" ");
  return [...cells.matchAll(/`([^`]+)`/g)].map((match) => match[1]);
}

/** `LDWx` stands for one with each relation. */
function spelled(name) {
  if (!/[A-Z]x$/.test(name)) return [name];
  return RELATIONS.map((relation) => name.slice(0, -1) + relation);
}

export async function writeMnemonics() {
  const rows = (await readFile(SOURCE, "utf8"))
    .split("\n")
    .filter((line) => line.startsWith("| `"));
  const all = [...new Set(rows.flatMap(names).flatMap(spelled))].sort();
  if (all.length < 150) throw new Error(`only ${all.length} mnemonics in ${SOURCE}`);
  const lines = [];
  for (const name of all) {
    const last = lines.length - 1;
    if (last >= 0 && lines[last].length + name.length < 95) lines[last] += ` ${name}`;
    else lines.push(name);
  }
  const text = `// Mnemonics, written by mnemonics.mjs from docs/instructions.md; do not edit.
export const MNEMONICS: ReadonlySet<string> = new Set(
  \`
${lines.join("\n")}
\`
    .trim()
    .split(/\\s+/),
);
`;
  await writeFile(TARGET, text);
}

// Names that a field offers: what the core would complete at the place in the text, and what the
// drawing has.
import type { Core } from "../core/core";
import type { Drawn, Item } from "./drawn";
import type { ElementId } from "./protocol";

const NAME = /%?[A-Za-z_][\w.]*/g;
/** Literals with words in them: `T#1s`, `'a'`. */
const LITERAL = /\w+#[\w.]+|'[^']*'/g;
const WORDS = /^(and|or|xor|not|true|false|mod)$/i;

/** The names of all steps of a chart. */
export function stepNames(drawn: Drawn, sheet: number): string[] {
  return drawn.sheet(sheet)?.steps.map(({ fullName }) => fullName) ?? [];
}

/** The step of a name, whatever the case of its letters. */
export function stepOf(drawn: Drawn, sheet: number, name: string): ElementId | undefined {
  const is = ({ fullName }: { fullName: string }) => fullName.toLowerCase() === name.toLowerCase();
  return drawn.sheet(sheet)?.steps.find(is)?.id;
}

/** What can be written into an action or a condition. */
export async function variables(
  core: Core,
  file: string,
  text: string,
  drawn: Drawn,
  item: Item,
): Promise<string[]> {
  const at = placeIn(text, item);
  const found = await core.ask({ do: "complete", file, at }).catch(() => []);
  const offered = found.filter(({ holes }) => holes.length === 0).map(({ label }) => label);
  const own = drawn.charts.sheets.flatMap(({ steps, transitions }) => [
    ...steps.flatMap(({ fullName, actions }) => [
      `${fullName}.X`,
      `${fullName}.T`,
      ...actions.flatMap(({ written }) => (written ? namesOf(written.action) : [])),
    ]),
    ...transitions.flatMap(({ condition }) => namesOf(condition)),
  ]);
  return [...new Set([...own, ...offered])].sort((a, b) => a.localeCompare(b));
}

function namesOf(text: string): string[] {
  const names = text.replace(LITERAL, " ").match(NAME) ?? [];
  return names.filter((name) => !WORDS.test(name));
}

/** Where a condition is written, or the actions of a step. */
function placeIn(text: string, { kind, element }: Item): number {
  let from = 0;
  for (let line = 1; line < element.line; line += 1) from = text.indexOf("\n", from) + 1;
  const mark = kind === "step" ? ":" : /\bTO\b[^]*?:=/i.exec(text.slice(from))?.[0];
  return mark === undefined ? from : text.indexOf(mark, from) + mark.length;
}

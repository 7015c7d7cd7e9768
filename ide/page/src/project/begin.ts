// Which project the page begins with: the one that its address names, the last one, or a lamp that
// blinks.
import { addressOf } from "../offline/address";
import { fromLink } from "./pack";
import { checked, Unfit, type Content } from "./project";
import { contentOf, kept, lastId } from "./storage";

/** The part of an address that holds a project, and the one that names an example. */
const LINKED = "project";
const EXAMPLE = "example";

/** A project, where it is kept, and what to show first. */
export interface Opened {
  id: string;
  title: string;
  content: Content;
}

/** What a new project has: two lines that everybody sees work. */
export const BLINK: Content = {
  files: [
    {
      name: "blink.awl",
      text: "NETWORK 1 // SM0.5 is on for half of each second\nLD     SM0.5\n=      Q0.0\n",
    },
  ],
  main: "blink.awl",
  plant: null,
  view: "plant",
};

/** The parts of the fragment of an address. */
export function fragmentParts(hash: string): Map<string, string> {
  const parts = hash.replace(/^#/, "").split("&").filter(Boolean);
  return new Map(
    parts.map((part) => {
      const [name = "", ...value] = part.split("=");
      return [name, decodeURIComponent(value.join("="))];
    }),
  );
}

/** The fragment of an address that opens this project again; what else it holds stays. */
export function fragmentFor(id: string): string {
  const parts = location.hash.replace(/^#/, "").split("&").filter(Boolean);
  const others = parts.filter((part) => !new RegExp(`^(${EXAMPLE}|${LINKED})=`).test(part));
  const linked = parts.filter((part) => part.startsWith(`${LINKED}=`) && id.startsWith("link:"));
  const example = id.startsWith("example:") ? [`${EXAMPLE}=${id.slice("example:".length)}`] : [];
  const all = [...example, ...linked, ...others];
  return all.length > 0 ? `#${all.join("&")}` : "";
}

/** The address of a project that it holds itself. */
export function linkTo(part: string): string {
  return `${location.origin}${location.pathname}#${LINKED}=${part}`;
}

/** An example as it was written; throws [`Unfit`]. */
export async function example(name: string): Promise<Opened> {
  if (!/^[\w-]{1,60}$/.test(name)) throw new Unfit("name", name);
  const answer = await fetch(addressOf(`examples/${name}.json`));
  if (!answer.ok) throw new Unfit("empty", name);
  const content = contentOf(await answer.json());
  if (!content) throw new Unfit("broken", name);
  return { id: `example:${name}`, title: name, content: checked(content, name) };
}

/** The names of the examples, where the server has a list of them. */
export async function exampleNames(): Promise<string[]> {
  try {
    const answer = await fetch(addressOf("examples/list.json"));
    const names = answer.ok ? ((await answer.json()) as unknown) : [];
    return Array.isArray(names) ? names.filter((name) => typeof name === "string") : [];
  } catch {
    return [];
  }
}

/** What is kept under this name. */
export function keptProject(id: string): Opened | null {
  const project = kept(id);
  return project && { id, title: project.title, content: project };
}

/** The link's project has a name that its content gives: opened again it is the edited one. */
function linked(part: string): Opened {
  const id = `link:${part.length}-${fnv(part)}`;
  return keptProject(id) ?? { id, title: "link", content: checked(fromLink(part), "link") };
}

/** FNV-1a, as hexadecimal digits: tells links apart, protects nothing. */
function fnv(text: string): string {
  let hash = 0x811c9dc5;
  for (const letter of text) hash = Math.imul(hash ^ (letter.codePointAt(0) ?? 0), 0x01000193);
  return (hash >>> 0).toString(16);
}

/** What the address asks for, edits kept; null where it asks for nothing. */
export async function fromAddress(hash: string): Promise<Opened | null> {
  const parts = fragmentParts(hash);
  const part = parts.get(LINKED);
  if (part) return linked(part);
  const name = parts.get(EXAMPLE);
  if (!name) return null;
  return keptProject(`example:${name}`) ?? (await example(name));
}

/** What to open where the address asks for nothing. */
export function lastOrBlink(): Opened {
  const last = lastId();
  const again = last === null ? null : keptProject(last);
  return again ?? { id: "own:blink", title: "blink", content: BLINK };
}

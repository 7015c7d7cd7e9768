// The exercises that the server has, and which of them have been solved in this browser.
import type { File } from "../core/protocol";
import { addressOf } from "../offline/address";
import type { Words } from "../text/language";
import type { Opened } from "./begin";
import { checked, Unfit } from "./project";
import { contentOf } from "./storage";

const PREFIX = "exercise:";
const SOLVED = "uno200.solved";

export interface Listed {
  name: string;
  title: Words;
}

export interface Exercise extends Listed {
  text: Words;
  /** Hidden: what is wanted, a behaviour each, and the plants for them. */
  scenarios: File[];
  plants: File[];
}

/** Where its project is kept. */
export function exerciseId(name: string): string {
  return PREFIX + name;
}

/** The exercise whose project this is. */
export function exerciseOf(id: string): string | null {
  return id.startsWith(PREFIX) ? id.slice(PREFIX.length) : null;
}

/** All of them; none where the server has no list. */
export async function listed(): Promise<Listed[]> {
  try {
    const answer = await fetch(addressOf("examples/exercises.json"));
    return answer.ok ? ((await answer.json()) as Listed[]) : [];
  } catch {
    return [];
  }
}

async function fetched(name: string): Promise<Exercise & { project: unknown }> {
  if (!/^[\w-]{1,60}$/.test(name)) throw new Unfit("name", name);
  const answer = await fetch(addressOf(`examples/exercise-${name}.json`));
  if (!answer.ok) throw new Unfit("empty", name);
  return { ...((await answer.json()) as Exercise & { project: unknown }), name };
}

/** An exercise, without its project; throws [`Unfit`]. */
export function exercise(name: string): Promise<Exercise> {
  return fetched(name);
}

/** Its project as it begins; throws [`Unfit`]. */
export async function exerciseAnew(name: string): Promise<Opened> {
  const { title, project } = await fetched(name);
  const content = contentOf(project);
  if (!content) throw new Unfit("broken", name);
  return { id: exerciseId(name), title: title[0], content: checked(content, name) };
}

/** Which have been solved. */
export function solved(): Set<string> {
  try {
    const names: unknown = JSON.parse(localStorage.getItem(SOLVED) ?? "[]");
    return new Set(Array.isArray(names) ? names.filter((name) => typeof name === "string") : []);
  } catch {
    return new Set();
  }
}

/** One more; where the browser has no room for that, it is not remembered. */
export function rememberSolved(name: string): void {
  try {
    localStorage.setItem(SOLVED, JSON.stringify([...solved().add(name)]));
  } catch {
    // Projects are worth more than this.
  }
}

// What people have chosen to look at: kept for each project by itself.
import type { Project } from "./project";
import { store, storedNames, storedText } from "./stored";

const PREFIX = "uno200.chosen.";

export type What = "watch" | "scope" | "capture";

const key = (id: string, what: What) => `${PREFIX}${id}.${what}`;

/** Forgets what was chosen in a project. */
export function forgetChosen(id: string): void {
  for (const name of storedNames(`${PREFIX}${id}.`)) store(name, null);
}

export class Chosen {
  constructor(
    private project: Project,
    private current: () => { id: string },
  ) {}

  keep(what: What, text: string): void {
    store(key(this.current().id, what), text);
  }

  text(what: What): string {
    return storedText(key(this.current().id, what)) ?? "";
  }

  /** Another project is open, with what was chosen in it. */
  onOpened(listener: () => void): void {
    this.project.onOpened(listener);
  }
}

// Keeps projects in the browser, so that a reload loses nothing. localStorage, because it can be
// written while the page is being left.
import type { Content, Project } from "./project";
import { forgetChosen } from "./chosen";
import { store, storedNames, storedText } from "./stored";

const PREFIX = "uno200.project.";
const LAST = "uno200.last";
/** So long after the last letter a project is kept. */
const QUIET_MS = 200;
/** So long another window has for giving a project up: a reload is another window for a moment. */
const LOCK_MS = 1000;

/** A project as it is kept. */
export interface Kept extends Content {
  id: string;
  title: string;
  changed: number;
}

function isContent(value: unknown): value is Content {
  const content = value as Partial<Content> | null;
  const isFile = (file: unknown) => {
    const { name, text } = (file ?? {}) as { name?: unknown; text?: unknown };
    return typeof name === "string" && typeof text === "string";
  };
  return (
    typeof content === "object" &&
    content !== null &&
    Array.isArray(content.files) &&
    content.files.every(isFile)
  );
}

/** Reads what somebody wrote as a project; nothing of it is believed. */
export function contentOf(value: unknown): Content | null {
  if (!isContent(value)) return null;
  const files = value.files.map(({ name, text }) => ({ name, text }));
  const main = typeof value.main === "string" ? value.main : null;
  const plant = typeof value.plant === "string" ? value.plant : null;
  const view = typeof value.view === "string" ? value.view : null;
  return { files, main, plant, view };
}

/** The project of this name, if it is kept. */
export function kept(id: string): Kept | null {
  try {
    const value = JSON.parse(storedText(PREFIX + id) ?? "null") as Partial<Kept> | null;
    const content = contentOf(value);
    if (!content || !value) return null;
    return { ...content, id, title: value.title ?? id, changed: value.changed ?? 0 };
  } catch {
    return null;
  }
}

/** All that are kept, the last ones first. */
export function allKept(): Kept[] {
  const all = storedNames(PREFIX).map((key) => kept(key.slice(PREFIX.length)));
  return all.filter((one) => one !== null).sort((a, b) => b.changed - a.changed);
}

export function forget(id: string): void {
  store(PREFIX + id, null);
  forgetChosen(id);
}

/** The project that was open last. */
export function lastId(): string | null {
  return storedText(LAST);
}

/** A name that no kept project has. */
export function freshId(): string {
  return `own:${Date.now().toString(36)}${Math.random().toString(36).slice(2, 8)}`;
}

/** Keeps the open project whenever it changes. */
export class Keeper {
  private id = "";
  private title = "";
  private timer = 0;
  private release = () => {};

  constructor(
    private project: Project,
    private failed: () => void,
  ) {
    project.onEdited(() => this.soon());
    project.onFiles(() => this.soon());
    addEventListener("pagehide", () => this.now());
    document.addEventListener("visibilitychange", () => this.now());
  }

  /** What is open from now on. Where another window has it, this is a copy with another name. */
  async begin(id: string, title: string): Promise<string> {
    this.now();
    this.release();
    const isMine = await this.lock(id);
    this.id = isMine ? id : freshId();
    this.title = title;
    if (!store(LAST, this.id)) this.failed();
    return this.id;
  }

  /** Keeps what is not yet kept. */
  now(): void {
    if (this.timer === 0 || this.id === "") return;
    clearTimeout(this.timer);
    this.timer = 0;
    const kept = { ...this.project.content(), title: this.title, changed: Date.now() };
    if (!store(PREFIX + this.id, JSON.stringify(kept))) this.failed();
  }

  private soon(): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.now(), QUIET_MS);
  }

  /** Two windows with one project would overwrite each other. */
  private lock(id: string): Promise<boolean> {
    if (!navigator.locks) return Promise.resolve(true);
    return new Promise((resolve) => {
      const held = new Promise<void>((release) => (this.release = release));
      const signal = AbortSignal.timeout(LOCK_MS);
      const take = () => {
        resolve(true);
        return held;
      };
      navigator.locks.request(`uno200.${id}`, { signal }, take).catch(() => resolve(false));
    });
  }
}

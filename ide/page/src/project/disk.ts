// The project that is a folder of this computer, reached by the bridge: what is written here is saved
// there, what is written there appears here, and where both happened somebody is asked.
import type { Bridge } from "../ports/bridge";
import type { Opened } from "./begin";
import type { Project } from "./project";
import { kept } from "./storage";
import { store, storedText } from "./stored";

/** So long after the last letter a file is saved. */
const QUIET_MS = 500;
/** From look to look whether somebody else has changed something. */
const LOOK_MS = 1500;
const DIRTY = "uno200.folder.";

/** What is done where a file was changed on both sides; null: nothing for now. */
export type Choice = "take" | "keep" | null;

/** Tells and asks what has to be told and asked. */
export interface Talk {
  choose(file: string, isGone: boolean): Promise<Choice>;
  changed(file: string): void;
  gone(file: string): void;
  unsaved(file: string): void;
  leftOut(files: { name: string; why: string }[]): void;
  note(text: string): void;
  failed(error: unknown): void;
}

/** A file as it is on the disk; no text: another one than here. */
interface OnDisk {
  version: string;
  text: string | null;
}

export class Disk {
  name = "";
  private id = "";
  private isOpen = false;
  private known = new Map<string, OnDisk>();
  /** Files that nobody wanted to decide about, until they are saved by hand. */
  private undecided = new Set<string>();
  private toldLeftOut = "";
  private timer = 0;
  /** What is done with the disk is done one after the other. */
  private queue: Promise<void> = Promise.resolve();

  constructor(
    private bridge: Bridge,
    private project: Project,
    /** Gives a file another text, which can be undone. */
    private replace: (file: string, text: string) => void,
    private talk: Talk,
  ) {
    project.onEdited(() => this.soon());
    project.onFiles(() => this.soon());
    setInterval(() => this.look(), LOOK_MS);
    addEventListener("focus", () => this.look());
    document.addEventListener("visibilitychange", () => this.look());
  }

  /** The folder as a project; what was not saved the last time is in it. */
  async open(): Promise<Opened> {
    const { id, name, files, leftOut } = await this.bridge.folder();
    this.isOpen = false;
    this.id = `folder:${id}`;
    this.name = name;
    this.known.clear();
    this.undecided.clear();
    for (const file of files) this.known.set(file.name, await this.bridge.read(file.name));
    this.tellLeftOut(leftOut);
    const last = kept(this.id);
    const texts = new Map([...this.known].map(([name, { text }]) => [name, text ?? ""]));
    for (const [name, base] of last ? this.unsavedLast() : []) {
      const draft = last?.files.find((file) => file.name === name)?.text;
      const there = this.known.get(name);
      // Somebody else was there in between: saving finds that, and asks.
      if (draft === undefined) texts.delete(name);
      else texts.set(name, draft);
      if ((there?.version ?? null) === base || there?.text === draft) continue;
      if (base === null) this.known.delete(name);
      else this.known.set(name, { version: base, text: null });
    }
    const content = {
      files: [...texts].map(([name, text]) => ({ name, text })),
      main: last?.main ?? null,
      plant: last?.plant ?? null,
      view: last?.view ?? null,
    };
    return { id: this.id, title: name, content };
  }

  /** Another project is open: whether it is this one. */
  opened(id: string): void {
    this.isOpen = id !== "" && id === this.id;
    if (this.isOpen) this.soon();
  }

  /** Whether the folder is the project that is open. */
  get isProject(): boolean {
    return this.isOpen;
  }

  /** Saves now what is not saved; fails with why it could not. */
  save(): Promise<void> {
    this.undecided.clear();
    return this.then(() => this.saveAll());
  }

  private soon(): void {
    if (!this.isOpen) return;
    this.remember();
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.quietly(() => this.saveAll()), QUIET_MS);
  }

  private look(): void {
    if (!this.isOpen || document.visibilityState !== "visible" || !this.bridge.isUp) return;
    this.quietly(() => this.lookAll());
  }

  private then(action: () => Promise<void>): Promise<void> {
    const done = this.queue.then(() => (this.isOpen ? action() : undefined));
    this.queue = done.catch(() => {});
    return done;
  }

  private quietly(action: () => Promise<void>): void {
    this.then(action).catch((error: unknown) => this.talk.failed(error));
  }

  private isDirty(file: string): boolean {
    return this.project.text(file) !== (this.known.get(file)?.text ?? undefined);
  }

  private names(): Set<string> {
    return new Set([...this.project.names(), ...this.known.keys()]);
  }

  /** Keeps which files are not saved, and what they were made of. */
  private remember(): void {
    const dirty = [...this.names()].filter((file) => this.isDirty(file));
    const bases = dirty.map((file) => [file, this.known.get(file)?.version ?? null] as const);
    const isAny = bases.length > 0;
    store(DIRTY + this.id, isAny ? JSON.stringify(Object.fromEntries(bases)) : null);
  }

  private unsavedLast(): [string, string | null][] {
    const value = JSON.parse(storedText(DIRTY + this.id) ?? "{}") as object;
    return Object.entries(value);
  }

  private async saveAll(): Promise<void> {
    for (const file of this.names())
      if (this.isDirty(file) && !this.undecided.has(file)) await this.saveOne(file);
    this.remember();
  }

  private async saveOne(file: string): Promise<void> {
    const text = this.project.text(file);
    const base = this.known.get(file)?.version ?? null;
    const told =
      text === undefined
        ? await this.bridge.remove(file, base ?? "")
        : await this.bridge.save(file, text, base);
    if (told.is === "changed") return this.decide(file, told.version);
    if (text === undefined) this.known.delete(file);
    else this.known.set(file, { version: told.version, text });
    if (told.note) this.talk.note(told.note);
  }

  /** Finds what somebody else has changed. */
  private async lookAll(): Promise<void> {
    const { files, leftOut } = await this.bridge.folder();
    this.tellLeftOut(leftOut);
    const there = new Map(files.map(({ name, version }) => [name, version]));
    for (const [file, version] of there) {
      if (this.known.get(file)?.version === version) continue;
      if (this.isDirty(file)) await this.decide(file, version);
      else await this.take(file, () => this.talk.changed(file));
    }
    for (const file of [...this.known.keys()]) {
      if (there.has(file) || leftOut.some(({ name }) => name === file)) continue;
      if (this.isDirty(file)) await this.decide(file, null);
      else {
        this.known.delete(file);
        this.project.remove(file);
        this.talk.gone(file);
      }
    }
  }

  /** Takes what is on the disk. */
  private async take(file: string, tell: () => void): Promise<void> {
    const before = this.project.text(file);
    const now = await this.bridge.read(file);
    // Meanwhile somebody has written here.
    if (this.project.text(file) !== before) return;
    this.known.set(file, now);
    const text = now.text ?? "";
    if (before === text) return;
    if (before === undefined) this.project.add(file, text);
    else this.replace(file, text);
    tell();
  }

  /** A file is another one on both sides: on the disk it has this version, or is gone. */
  private async decide(file: string, version: string | null): Promise<void> {
    if (this.undecided.has(file)) return;
    const choice = await this.talk.choose(file, version === null);
    if (choice === null) {
      this.undecided.add(file);
      this.talk.unsaved(file);
    } else if (choice === "keep") {
      if (version === null) this.known.delete(file);
      else this.known.set(file, { version, text: null });
      await this.saveOne(file);
    } else if (version === null) {
      this.known.delete(file);
      this.project.remove(file);
    } else await this.take(file, () => {});
    this.remember();
  }

  private tellLeftOut(files: { name: string; why: string }[]): void {
    const told = JSON.stringify(files);
    if (files.length > 0 && told !== this.toldLeftOut) this.talk.leftOut(files);
    this.toldLeftOut = told;
  }
}

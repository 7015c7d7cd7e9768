// The project that is open: its files and which one is the program. What is done with it is told
// to whoever listens; the editors and the core are among them.
import type { Core } from "../core/core";
import type { File } from "../core/protocol";

/** Endings of programs, in the order in which one is taken as the main one. */
const PROGRAMS = [".awl", ".st", ".sfc", ".fbd", ".fbt", ".xml"];
/** What a file of a project may end with. */
export const ENDINGS = [...PROGRAMS, ".scn", ".csv", ".txt", ".md", ".json", ".plant"];
/** Whether a file of this name can be run. */
export function isProgram(name: string): boolean {
  return PROGRAMS.some((ending) => name.toLowerCase().endsWith(ending));
}

/** More than any program has; foreign projects are limited by it. */
export const FILES_MAX = 200;
export const BYTES_MAX = 4_000_000;
/** So long letters are collected before the core sees them. */
const COLLECT_MS = 15;

export interface Content {
  files: File[];
  main: string | null;
  /** The plant that goes with it. */
  plant: string | null;
  /** The panel that is shown. */
  view: string | null;
}

/** Why a project or a file cannot be taken. */
export class Unfit extends Error {
  constructor(
    readonly reason: "name" | "exists" | "tooMany" | "tooLarge" | "empty" | "broken",
    readonly what = "",
  ) {
    super(reason);
  }
}

/** A name that a file can have: no absolute path, no way out, a known ending. */
export function isName(name: string): boolean {
  const parts = name.split("/");
  const isPart = (part: string) => /^[^\\:*?"<>|\x00-\x1f]{1,80}$/.test(part) && part[0] !== ".";
  const ending = ENDINGS.some((ending) => name.toLowerCase().endsWith(ending));
  return ending && parts.length <= 8 && parts.every(isPart);
}

/** Checks what comes from elsewhere, from `where`; throws [`Unfit`]. */
export function checked(content: Content, where: string): Content {
  const { files } = content;
  if (files.length === 0) throw new Unfit("empty", where);
  if (files.length > FILES_MAX) throw new Unfit("tooMany", String(FILES_MAX));
  const wrong = files.find((file) => !isName(file.name));
  if (wrong) throw new Unfit("name", wrong.name);
  const size = files.reduce((sum, file) => sum + file.text.length, 0);
  if (size > BYTES_MAX) throw new Unfit("tooLarge", `${BYTES_MAX / 1e6} MB`);
  return content;
}

export class Project {
  plant: string | null = null;
  view: string | null = null;
  private texts = new Map<string, string>();
  private chosen: string | null = null;
  private waiting = new Map<string, number>();
  private openedListeners: (() => void)[] = [];
  private filesListeners: (() => void)[] = [];
  private renamedListeners: ((file: string, to: string) => void)[] = [];
  private editedListeners: ((file: string) => void)[] = [];

  constructor(private core: Core) {
    core.beforeQuestion = () => this.flush();
  }

  /** Takes the place of the project that was open. */
  open(content: Content): void {
    this.waiting.clear();
    this.texts = new Map(content.files.map((file) => [file.name, file.text]));
    this.chosen = content.main;
    this.plant = content.plant;
    this.view = content.view;
    this.core.tell({ do: "open", files: this.files(), main: this.main() });
    for (const listener of this.openedListeners) listener();
    this.changed();
  }

  content(): Content {
    return { files: this.files(), main: this.chosen, plant: this.plant, view: this.view };
  }

  files(): File[] {
    return [...this.texts].map(([name, text]) => ({ name, text }));
  }

  names(): string[] {
    return [...this.texts.keys()].sort((a, b) => a.localeCompare(b));
  }

  text(file: string): string | undefined {
    return this.texts.get(file);
  }

  /** The name of what is run, without folder and ending; `otherwise` where there is nothing. */
  stem(otherwise: string): string {
    return (this.main() ?? otherwise).replace(/^.*\/|\.[^.]*$/g, "");
  }

  /** The file that is run: the chosen one, or the first program there is. */
  main(): string | null {
    if (this.chosen !== null && this.texts.has(this.chosen)) return this.chosen;
    for (const ending of PROGRAMS) {
      const names = this.names().filter((name) => name.toLowerCase().endsWith(ending));
      // Blocks and functions alone are a part of another file's program.
      const main = names.find((name) => ending !== ".st" || this.hasProgram(name)) ?? names[0];
      if (main !== undefined) return main;
    }
    return null;
  }

  private hasProgram(name: string): boolean {
    return /^\s*PROGRAM\s/im.test(this.texts.get(name) ?? "");
  }

  choose(main: string): void {
    this.chosen = main;
    this.core.tell({ do: "choose", main });
    this.changed();
  }

  setPlant(spec: string | null): void {
    this.plant = spec;
    this.changed();
  }

  setView(view: string): void {
    if (this.view === view) return;
    this.view = view;
    this.changed();
  }

  /** A file has another text. */
  edit(file: string, text: string): void {
    if (this.texts.get(file) === text) return;
    this.texts.set(file, text);
    if (!this.waiting.has(file))
      this.waiting.set(
        file,
        window.setTimeout(() => this.sendEdit(file), COLLECT_MS),
      );
    for (const listener of this.editedListeners) listener(file);
  }

  /** Sends what the core has not seen yet. */
  flush(): void {
    for (const file of [...this.waiting.keys()]) this.sendEdit(file);
  }

  private sendEdit(file: string): void {
    window.clearTimeout(this.waiting.get(file));
    this.waiting.delete(file);
    const text = this.texts.get(file);
    if (text !== undefined) this.core.tell({ do: "edit", file, text });
  }

  add(file: string, text: string): void {
    if (!isName(file)) throw new Unfit("name", file);
    if (this.texts.has(file)) throw new Unfit("exists", file);
    this.texts.set(file, text);
    this.core.tell({ do: "edit", file, text });
    this.changed();
  }

  remove(file: string): void {
    if (!this.texts.delete(file)) return;
    this.core.tell({ do: "remove", file });
    this.changed();
  }

  rename(file: string, to: string): void {
    const text = this.texts.get(file);
    if (text === undefined || file === to) return;
    if (!isName(to)) throw new Unfit("name", to);
    if (this.texts.has(to)) throw new Unfit("exists", to);
    this.flush();
    this.texts.delete(file);
    this.texts.set(to, text);
    if (this.chosen === file) this.chosen = to;
    this.core.tell({ do: "rename", file, to });
    for (const listener of this.renamedListeners) listener(file, to);
    this.changed();
  }

  /** Another project is open. */
  onOpened(listener: () => void): void {
    this.openedListeners.push(listener);
  }

  /** A file has another name. */
  onRenamed(listener: (file: string, to: string) => void): void {
    this.renamedListeners.push(listener);
  }

  /** There are other files, or another one is the program. */
  onFiles(listener: () => void): void {
    this.filesListeners.push(listener);
  }

  /** The text of a file is another one. */
  onEdited(listener: (file: string) => void): void {
    this.editedListeners.push(listener);
  }

  private changed(): void {
    for (const listener of this.filesListeners) listener();
  }
}

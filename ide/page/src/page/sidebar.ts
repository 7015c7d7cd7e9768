// The left side: files, outline, and what was searched for.
import type { Core } from "../core/core";
import type { Item, Place } from "../core/protocol";
import type { Editors } from "../editor/editors";
import { Unfit, type Project } from "../project/project";
import { t, type Key } from "../text/language";
import { ask, confirm } from "./dialog";
import { h, iconButton, newId, say } from "./dom";
import { icon } from "./icons";
import { openMenu, type MenuItem } from "./menu";
import { notice } from "./notices";
import { unfitWords } from "./unfit";

const OUTLINE_MS = 300;
const FOUND_MAX = 500;

export class Sidebar {
  readonly element: HTMLElement;
  private files = h("ul", { class: "list" });
  private outline = h("ul", { class: "list outline" });
  private found = h("ul", { class: "list found" });
  private foundTitle = h("p", { class: "found-title", attributes: { "aria-live": "polite" } });
  private searchField: HTMLInputElement;
  private timer = 0;
  private outlined: Item[] = [];
  private drawn = "";

  constructor(
    private core: Core,
    private project: Project,
    private editors: Editors,
    private search: (text: string) => Place[],
  ) {
    this.searchField = h("input", {
      label: "searchFiles",
      placeholder: "searchFiles",
      attributes: { type: "search", spellcheck: "false", autocomplete: "off" },
      on: { input: () => this.searchAll() },
    });
    const add = iconButton(icon("add"), "newFile", () => void this.newFile());
    this.element = h(
      "nav",
      { class: "sidebar", label: "projectParts" },
      section("files", [add], this.files),
      section("outline", [], this.outline),
      section("search", [], this.searchField, this.foundTitle, this.found),
    );
    project.onFiles(() => this.drawFiles());
    project.onEdited(() => this.soon());
    editors.onCurrent(() => {
      this.drawFiles();
      this.soon();
    });
  }

  private drawFiles(): void {
    const main = this.project.main();
    const focused = document.activeElement?.getAttribute("data-file");
    this.files.replaceChildren(...this.project.names().map((name) => this.fileRow(name, main)));
    if (focused != null)
      this.files.querySelector<HTMLElement>(`[data-file="${CSS.escape(focused)}"]`)?.focus();
  }

  private fileRow(name: string, main: string | null): HTMLElement {
    const open = h(
      "button",
      {
        class: "row",
        attributes: {
          type: "button",
          "data-file": name,
          "aria-current": name === this.editors.current ? "true" : undefined,
        },
        on: {
          click: () => this.editors.open(name),
          keydown: (event) => {
            if (event.key === "F2") void this.renameFile(name);
            if (event.key === "Delete") void this.removeFile(name);
          },
        },
      },
      h("span", {}, name),
      name === main && h("span", { class: "tag", text: "mainProgram" }),
    );
    const more = iconButton(
      icon("more"),
      "fileMenu",
      () => openMenu(more, [this.items(name)]),
      name,
    );
    more.setAttribute("aria-haspopup", "menu");
    more.setAttribute("aria-expanded", "false");
    return h("li", {}, open, more);
  }

  private items(name: string): MenuItem[] {
    return [
      { text: t("makeMain"), act: () => this.project.choose(name), disabled: /\.scn$/i.test(name) },
      { text: t("renameFile"), act: () => void this.renameFile(name), hint: "F2" },
      { text: t("deleteFile"), act: () => void this.removeFile(name), hint: "Del" },
    ];
  }

  /** Asks for a name and adds a file. */
  async newFile(): Promise<void> {
    const name = await ask(t("newFile"), "fileName", "new.awl", "create");
    if (name === null) return;
    if (attempt(() => this.project.add(name, ""))) this.editors.open(name);
  }

  async renameFile(name: string): Promise<void> {
    const to = await ask(t("renameFileTitle", name), "newName", name, "rename");
    if (to !== null) attempt(() => this.project.rename(name, to));
  }

  private async removeFile(name: string): Promise<void> {
    if (await confirm("deleteFile", "deleteFileAsk", "delete", name)) this.project.remove(name);
  }

  private soon(): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.drawOutline(), OUTLINE_MS);
  }

  private async drawOutline(): Promise<void> {
    const file = this.editors.current;
    const ask = file === null ? [] : this.core.ask({ do: "outline", file });
    const items = await Promise.resolve(ask).catch(() => []);
    if (file !== this.editors.current) return;
    this.outlined = items;
    // Within a line nothing changes but offsets: what is drawn stays.
    const drawn = items.map(({ name, kind, line }) => `${line} ${kind} ${name}`).join("\n");
    if (drawn === this.drawn) return;
    this.drawn = drawn;
    this.outline.replaceChildren(...items.map((item, index) => this.outlineRow(item, index)));
  }

  private outlineRow({ name, kind, line }: Item, index: number): HTMLElement {
    const words = name || t("network", line);
    const show = () => {
      const from = this.outlined[index]?.from ?? 0;
      if (this.editors.current !== null)
        this.editors.open(this.editors.current, { from, to: from });
    };
    const row = h("button", {
      class: `row ${kind}`,
      attributes: { type: "button" },
      on: { click: show },
    });
    row.append(h("span", {}, words), h("span", { class: "line-number" }, String(line)));
    return h("li", {}, row);
  }

  private searchAll(): void {
    const text = this.searchField.value;
    this.showFound("", this.search(text));
    if (text !== "") this.foundTitle.textContent = t("foundPlaces", this.found.childElementCount);
  }

  /** Shows places, those with `title` in place of a search. */
  showFound(title: string, places: Place[]): void {
    if (title !== "") this.searchField.value = "";
    this.foundTitle.textContent = title;
    this.found.replaceChildren(...places.slice(0, FOUND_MAX).map((place) => this.foundRow(place)));
    if (title !== "") this.found.querySelector("button")?.focus();
  }

  private foundRow(place: Place): HTMLElement {
    const text = this.project.text(place.file) ?? "";
    const before = text.slice(0, place.from);
    const line = before.split("\n").length;
    const start = before.lastIndexOf("\n") + 1;
    const end = text.indexOf("\n", place.from);
    const words = text.slice(start, end < 0 ? undefined : end).trim();
    const show = () => this.editors.openPlace(place);
    const row = h("button", { class: "row", attributes: { type: "button" }, on: { click: show } });
    row.append(h("span", { class: "where" }, `${place.file}:${line}`), h("code", {}, words));
    return h("li", {}, row);
  }

  /** Goes to the field for searching. */
  focusSearch(): void {
    this.searchField.focus();
    this.searchField.select();
  }
}

function section(title: Key, actions: HTMLElement[], ...content: HTMLElement[]): HTMLElement {
  const heading = h("h2", { attributes: { id: newId() } });
  say(heading, "text", title);
  const head = h("div", { class: "head" }, heading, ...actions);
  return h("section", { attributes: { "aria-labelledby": heading.id } }, head, ...content);
}

/** Does something that a name may be unfit for, and tells it. */
function attempt(act: () => void): boolean {
  try {
    act();
    return true;
  } catch (error) {
    if (!(error instanceof Unfit)) throw error;
    notice(unfitWords(error), true);
    return false;
  }
}

// An editor with a tab for each file that is open in it.
import { EditorView } from "@codemirror/view";
import type { EditorState, StateEffect } from "@codemirror/state";
import { h, iconButton, newId, say } from "../page/dom";
import { icon } from "../page/icons";
import { moveInTabs } from "../page/tabs";

/** A file that is open: its text, history and place. */
export interface Sheet {
  state: EditorState;
  scroll?: StateEffect<unknown>;
}

interface Owner {
  sheet(file: string): Sheet | undefined;
  chosen(pane: Pane): void;
  closed(pane: Pane, file: string): void;
  renamed(file: string): void;
}

export class Pane {
  readonly element: HTMLElement;
  readonly view: EditorView;
  readonly files: string[] = [];
  current: string | null = null;
  private list: HTMLElement;
  private place: HTMLElement;
  private nothing = h("p", { class: "nothing", text: "noFileOpen" });

  constructor(
    private owner: Owner,
    actions: HTMLElement[],
  ) {
    this.view = new EditorView();
    this.list = h("div", {
      class: "tabs files",
      label: "openFiles",
      attributes: { role: "tablist" },
    });
    this.list.addEventListener("keydown", (event) => this.keys(event));
    this.place = h(
      "div",
      { class: "place", attributes: { role: "tabpanel", id: newId() } },
      this.view.dom,
      this.nothing,
    );
    this.element = h(
      "section",
      { class: "pane" },
      h("div", { class: "bar" }, this.list, h("div", { class: "actions" }, ...actions)),
      this.place,
    );
    this.element.addEventListener("focusin", () => owner.chosen(this));
    this.show(null);
  }

  /** Shows a file, with a tab of its own; nothing for null. */
  show(file: string | null): void {
    this.leave();
    const sheet = file === null ? undefined : this.owner.sheet(file);
    this.current = sheet ? file : null;
    if (file !== null && sheet && !this.files.includes(file)) this.files.push(file);
    this.view.dom.hidden = !sheet;
    this.nothing.hidden = !!sheet;
    if (sheet) {
      this.view.setState(sheet.state);
      if (sheet.scroll) this.view.dispatch({ effects: sheet.scroll });
    }
    this.drawTabs();
  }

  /** Keeps the state of what is shown. */
  leave(): void {
    const sheet = this.current === null ? undefined : this.owner.sheet(this.current);
    if (!sheet) return;
    sheet.state = this.view.state;
    sheet.scroll = this.view.scrollSnapshot();
  }

  /** Takes a file out; its neighbour is shown. */
  remove(file: string): void {
    const at = this.files.indexOf(file);
    if (at < 0) return;
    this.files.splice(at, 1);
    if (this.current !== file) return this.drawTabs();
    this.leave();
    this.current = null;
    this.show(this.files[Math.min(at, this.files.length - 1)] ?? null);
  }

  /** A file has another name; its state is a new one. */
  rename(file: string, to: string): void {
    const at = this.files.indexOf(file);
    if (at < 0) return;
    this.files[at] = to;
    if (this.current === file) {
      this.current = null;
      this.show(to);
    } else this.drawTabs();
  }

  private drawTabs(): void {
    const tabs = this.files.map((file) => this.tab(file));
    this.list.replaceChildren(...tabs.flat());
    this.list.hidden = tabs.length === 0;
    const selected = this.list.querySelector<HTMLElement>("[aria-selected=true]");
    if (selected) this.place.setAttribute("aria-labelledby", selected.id);
    else this.place.removeAttribute("aria-labelledby");
    selected?.scrollIntoView({ block: "nearest", inline: "nearest" });
  }

  private tab(file: string): HTMLElement[] {
    const isCurrent = file === this.current;
    const tab = h(
      "button",
      {
        attributes: {
          type: "button",
          role: "tab",
          id: newId(),
          title: file,
          "aria-selected": String(isCurrent),
          "aria-controls": this.place.id,
          tabindex: isCurrent ? 0 : -1,
        },
        on: {
          click: () => this.show(file),
          auxclick: () => this.owner.closed(this, file),
          dblclick: () => this.owner.renamed(file),
        },
      },
      file,
    );
    if (!isCurrent) return [tab];
    const close = iconButton(icon("close"), "closeFile", () => this.owner.closed(this, file), file);
    close.classList.add("close");
    // A list of tabs holds tabs alone; by keyboard it is the key Delete.
    close.tabIndex = -1;
    close.setAttribute("aria-hidden", "true");
    return [tab, close];
  }

  private keys(event: KeyboardEvent): void {
    if (event.key === "Delete" && this.current !== null) this.owner.closed(this, this.current);
    else if (event.key === "F2" && this.current !== null) this.owner.renamed(this.current);
    else {
      const before = this.current;
      moveInTabs(event, this.list);
      if (this.current === before) return;
      this.list.querySelector<HTMLElement>("[aria-selected=true]")?.focus();
    }
    event.preventDefault();
  }

  /** Names the pane. */
  name(number: number): void {
    say(this.element, "aria-label", "editorPane", number);
  }
}

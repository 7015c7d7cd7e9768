// What can be done at the cursor with the core's help: go to the definition, find uses, rename,
// format, explain.
import type { Command, EditorView, KeyBinding } from "@codemirror/view";
import { Refusal, type Core } from "../core/core";
import type { Place } from "../core/protocol";
import { ask, dialog } from "../page/dialog";
import { addressOf } from "../offline/address";
import { notice } from "../page/notices";
import type { Project } from "../project/project";
import { t } from "../text/language";
import type { Editors } from "./editors";
import { markdown } from "./markdown";

/** Shows places that were found. */
export type ShowFound = (title: string, places: Place[]) => void;

export class Commands {
  constructor(
    private core: Core,
    private project: Project,
    /** Not there yet while the editors themselves are made. */
    private editors: () => Editors,
    private showFound: ShowFound,
    private chooseValue: () => void,
  ) {}

  /** Keys of an editor; the rest of the page has its own. */
  readonly keys: KeyBinding[] = [
    { key: "F12", run: this.command(() => this.definition()) },
    { key: "Shift-F12", run: this.command(() => this.references()) },
    { key: "F2", run: this.command(() => void this.rename()) },
    { key: "Shift-Alt-f", run: this.command(() => this.format()) },
    { key: "Alt-Enter", run: this.command(() => this.chooseValue()) },
  ];

  private command(act: () => void | Promise<void>): Command {
    return () => {
      void this.guard(act);
      return true;
    };
  }

  /** Tells what the core refuses. */
  private async guard(act: () => void | Promise<void>): Promise<void> {
    try {
      await act();
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      notice(error.message, true);
    }
  }

  private where(): { file: string; at: number } | null {
    const { current, view } = this.editors();
    return current === null ? null : { file: current, at: view.state.selection.main.head };
  }

  async definition(where = this.where()): Promise<void> {
    if (!where) return;
    const place = await this.core.ask({ do: "definition", ...where });
    if (place) this.editors().openPlace(place);
    else notice(t("noDefinition"));
  }

  async references(): Promise<void> {
    const where = this.where();
    if (!where) return;
    const places = await this.core.ask({ do: "references", ...where });
    const { state } = this.editors().view;
    const word = state.wordAt(where.at);
    const name = word ? state.sliceDoc(word.from, word.to) : "";
    if (places.length === 0) notice(t("noReferences"));
    else this.showFound(t("referencesOf", name), places);
  }

  /** Gives what is at a place another name; that name, or null where nothing is renamed. */
  async rename(where = this.where()): Promise<string | null> {
    const state = where ? this.editors().viewOf(where.file)?.state : undefined;
    const word = where && state?.wordAt(where.at);
    const before = word ? state?.sliceDoc(word.from, word.to) : undefined;
    if (!where || before === undefined) {
      notice(t("nothingToRename"));
      return null;
    }
    const to = await ask(t("renameSymbol", before), "newName", before, "rename");
    if (to === null || to === before) return null;
    let renamed: string | null = null;
    await this.guard(async () => {
      const edits = await this.core.ask({ do: "renameSymbol", ...where, to });
      this.editors().apply(edits);
      notice(t("renamed", edits.length));
      renamed = to;
    });
    return renamed;
  }

  async format(): Promise<void> {
    const file = this.editors().current;
    if (file === null) return;
    await this.guard(async () => {
      this.editors().apply(await this.core.ask({ do: "format", file }));
    });
  }

  async explain(code: string): Promise<void> {
    try {
      const answer = await fetch(addressOf(`errors/${code}.md`));
      if (!answer.ok) throw new Error(String(answer.status));
      await dialog({ title: code, body: [markdown(await answer.text())] });
    } catch (error) {
      notice(t("noExplanation", code, String(error)), true);
    }
  }

  /** Ctrl and a click go to the definition, too. */
  click(event: MouseEvent, view: EditorView): void {
    if (!event.ctrlKey && !event.metaKey) return;
    const at = view.posAtCoords({ x: event.clientX, y: event.clientY });
    const file = this.editors().current;
    if (at === null || file === null) return;
    event.preventDefault();
    void this.guard(() => this.definition({ file, at }));
  }

  /** Places with this text, in all files. */
  search(text: string): Place[] {
    const wanted = text.toLowerCase();
    if (wanted === "") return [];
    return this.project.files().flatMap(({ name, text }) => {
      const places: Place[] = [];
      const where = text.toLowerCase();
      for (let at = where.indexOf(wanted); at >= 0; at = where.indexOf(wanted, at + 1))
        places.push({ file: name, from: at, to: at + wanted.length });
      return places;
    });
  }
}

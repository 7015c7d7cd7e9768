// Keys in the drawing: along its lines, and those of commands.
import type { ChartEditor } from "./editor";
import { place, shift } from "./edits";
import { next } from "./ways";
import type { Point } from "./drawn";

/** So far a key moves steps. */
const MOVED = 10;
const ARROWS: Record<string, Point> = {
  ArrowLeft: [-MOVED, 0],
  ArrowRight: [MOVED, 0],
  ArrowUp: [0, -MOVED],
  ArrowDown: [0, MOVED],
};
/** What the browser does with these comes back as an event of the clipboard. */
const CLIPBOARD = ["Ctrl+C", "Ctrl+X", "Ctrl+V"];

export class Keyboard {
  /** Whether Space is held: then a drag moves the ground. */
  isSpace = false;
  /** What is written until the field is there that it is for. */
  private written: string | null = null;

  constructor(private editor: ChartEditor) {
    const { stage } = editor;
    stage.addEventListener("keydown", (event) => this.pressed(event));
    stage.addEventListener("keyup", (event) => {
      if (event.key === " ") this.isSpace = false;
    });
    stage.addEventListener("focusout", () => (this.isSpace = false));
  }

  takeWritten(): string {
    const { written } = this;
    this.written = null;
    return written ?? "";
  }

  /** A key in the drawing. */
  pressed(event: KeyboardEvent): void {
    const name = nameOf(event);
    if (this.written !== null && event.key.length === 1) this.written += event.key;
    else if (this.written !== null && event.key === "Enter") this.written += "\n";
    else if (CLIPBOARD.includes(name)) return;
    else if (!this.walk(event, name) && !this.command(name)) return;
    event.preventDefault();
    event.stopPropagation();
  }

  private command(key: string): boolean {
    const { commands } = this.editor;
    const name = commands.ofKey(key);
    if (!name) return false;
    if (commands.opensField(name)) this.written = "";
    void commands.run(name).then(() => {
      if (commands.opensField(name)) this.written = null;
    });
    return true;
  }

  /** Goes to another element, selects, or moves what is selected. */
  private walk(event: KeyboardEvent, name: string): boolean {
    const { selection } = this.editor;
    const by = ARROWS[event.key];
    if (name === " ") {
      this.isSpace = true;
      return true;
    }
    if (name === "Ctrl+ ") this.toggle();
    else if (name === "Escape") selection.clear();
    else if (by && name === `Ctrl+${event.key}`) void this.editor.perform(() => this.move(by));
    else if (/^(Shift\+)?(Arrow|Home$|End$|Page)/.test(name)) this.go(event);
    else return false;
    return true;
  }

  private toggle(): void {
    const { scene, selection } = this.editor;
    if (scene?.focus) selection.toggle(scene.focus);
  }

  private go(event: KeyboardEvent): void {
    const { editor } = this;
    const { scene, selection } = editor;
    if (!scene) return;
    const from = scene.focus ?? scene.drawn.ofSheet(editor.only ?? 0)[0];
    if (!from) return;
    const to = next(scene.drawn, { item: from, action: scene.action }, event.key);
    if (!to) return;
    if (event.shiftKey && to.action === null) selection.add([from, to.item]);
    else selection.only(to.item, to.action);
    editor.focus();
  }

  private async move(by: Point): Promise<void> {
    const { editor } = this;
    const { scene } = editor;
    if (!scene || scene.items.length === 0) return;
    const moved = shift(scene.items, by);
    await editor.change(scene.sheet, [place(scene.drawn, scene.sheet, moved)]);
    editor.focus();
  }
}

/** A key with what is held: letters are large ones. */
function nameOf(event: KeyboardEvent): string {
  const held = [
    (event.ctrlKey || event.metaKey) && "Ctrl",
    event.altKey && "Alt",
    event.shiftKey && "Shift",
  ];
  const key = event.key.length === 1 ? event.key.toUpperCase() : event.key;
  return [...held.filter(Boolean), key].join("+");
}

// Steps as a text in the clipboard: they can be pasted into any chart, or into a file of text.
import { Refusal } from "../core/core";
import { t } from "../text/language";
import type { ChartEditor } from "./editor";
import type { ElementId } from "./protocol";

export class Clipboard {
  private prepared: { ids: ElementId[] | null; text: string } = { ids: null, text: "" };

  constructor(private editor: ChartEditor) {
    document.addEventListener("copy", (event) => this.asked(event, false));
    document.addEventListener("cut", (event) => this.asked(event, true));
    document.addEventListener("paste", (event) => {
      const text = event.clipboardData?.getData("text/plain");
      if (!this.isForChart || !text) return;
      event.preventDefault();
      void editor.perform(() => this.paste(text));
    });
  }

  private get isForChart(): boolean {
    return this.editor.hasFocus && !this.editor.field.isOpen;
  }

  private asked(event: ClipboardEvent, isCut: boolean): void {
    if (!this.isForChart) return;
    event.preventDefault();
    const isReady = this.prepared.ids === this.editor.selection.ids;
    if (isReady) event.clipboardData?.setData("text/plain", this.prepared.text);
    if (isCut) void this.editor.perform(() => (isReady ? this.erase() : this.cut()));
    else if (!isReady) void this.editor.perform(() => this.copy());
  }

  /** An event of the clipboard does not wait for an answer: it is asked for before. */
  prepare(): void {
    const { ids } = this.editor.selection;
    this.text().then(
      (text) => (this.prepared = { ids, text }),
      () => {},
    );
  }

  private async text(): Promise<string> {
    const { scene, document } = this.editor;
    const steps = scene?.items.filter(({ kind }) => kind === "step") ?? [];
    if (!scene || steps.length === 0) throw new Refusal(t("chartSelectStep"));
    return document.copy(
      scene.sheet,
      steps.map(({ id }) => id),
    );
  }

  async copy(): Promise<void> {
    // It begins now: later the browser does not see that somebody wanted it.
    const text = this.text();
    const blob = text.then((text) => new Blob([text], { type: "text/plain" }));
    try {
      await navigator.clipboard.write([new ClipboardItem({ "text/plain": blob })]);
    } catch {
      await text;
      throw new Refusal(t("chartNoClipboard"));
    }
  }

  async cut(): Promise<void> {
    await this.copy();
    await this.erase();
  }

  private async erase(): Promise<void> {
    const { scene } = this.editor;
    if (!scene) return;
    const elements = scene.items.map(({ id }) => id);
    await this.editor.change(scene.sheet, [{ erase: { elements } }]);
    this.editor.focus();
  }

  async pasteFromSystem(): Promise<void> {
    const text = await navigator.clipboard?.readText().catch(() => "");
    if (!text) throw new Refusal(t("chartNoClipboard"));
    await this.paste(text);
  }

  private async paste(text: string): Promise<void> {
    await this.editor.change(this.editor.selection.sheet, [{ paste: { text, at: null } }]);
    this.editor.focus();
  }

  async duplicate(): Promise<void> {
    await this.paste(await this.text());
  }
}

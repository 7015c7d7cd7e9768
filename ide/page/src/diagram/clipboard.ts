// Elements as a text in the clipboard: it can be pasted into any diagram, or into a file.

interface Acts {
  /** Whether somebody works in the diagram. */
  isHere(): boolean;
  remove(): void;
  paste(text: string): void;
}

export class Clipboard {
  /** An event of the clipboard does not wait for an answer: it is asked for before. */
  private text = "";
  private asked = 0;

  constructor(private acts: Acts) {
    document.addEventListener("copy", (event) => this.give(event));
    document.addEventListener("cut", (event) => this.give(event) && acts.remove());
    document.addEventListener("paste", (event) => {
      const text = event.clipboardData?.getData("text/plain");
      if (!acts.isHere() || !text) return;
      event.preventDefault();
      acts.paste(text);
    });
  }

  /** Takes the text of what is chosen now. */
  async prepare(text: Promise<string>): Promise<void> {
    const number = ++this.asked;
    this.text = "";
    const found = await text.catch(() => "");
    if (number === this.asked) this.text = found;
  }

  private give(event: ClipboardEvent): boolean {
    if (!this.acts.isHere() || this.text === "") return false;
    event.preventDefault();
    event.clipboardData?.setData("text/plain", this.text);
    return true;
  }
}

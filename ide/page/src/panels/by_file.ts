// A panel with several contents: which one is seen the file in the editor decides.
import type { Editors } from "../editor/editors";
import { h } from "../page/dom";
import type { Lazy } from "./lazy";

export class ByFile {
  readonly element: HTMLElement;
  private isShown = false;
  private current: Lazy | undefined;

  /** `special`: for files of this kind, instead of the usual one. */
  constructor(
    private editors: Editors,
    private usual: Lazy,
    private special: { files: RegExp; contents: Lazy },
  ) {
    const all = [usual.element, special.contents.element];
    for (const one of all) one.classList.add("panel");
    this.element = h("div", { class: "by-file" }, ...all);
    editors.onCurrent(() => this.choose());
    this.choose();
  }

  shown(isShown: boolean): void {
    this.isShown = isShown;
    this.current?.shown(isShown);
  }

  private choose(): void {
    const { usual, special, editors } = this;
    const isSpecial = special.files.test(editors.current ?? "");
    const chosen = isSpecial ? special.contents : usual;
    usual.element.hidden = isSpecial;
    special.contents.element.hidden = !isSpecial;
    if (chosen === this.current) return;
    if (this.isShown) this.current?.shown(false);
    this.current = chosen;
    if (this.isShown) chosen.shown(true);
  }
}

// Tabs for the charts of a file: all of them, or one.
import { h, newId, say } from "../page/dom";
import { moveInTabs } from "../page/tabs";
import type { ChartSheet } from "./protocol";

export class Sheets {
  readonly element = h("div", {
    class: "tabs",
    label: "chartSheets",
    attributes: { role: "tablist" },
    on: { keydown: (event) => moveInTabs(event, this.element) },
  });
  private tabs: HTMLElement[] = [];

  constructor(private chosen: (only: number | null) => void) {}

  /** Shows which charts there are, and the one that is shown; all for null. */
  show(sheets: readonly ChartSheet[], only: number | null): void {
    this.element.hidden = sheets.length < 2;
    while (this.tabs.length > sheets.length + 1) this.tabs.pop()?.remove();
    for (let at = 0; at <= sheets.length; at += 1) {
      const tab = (this.tabs[at] ??= this.tab(at));
      const sheet = sheets[at - 1];
      if (sheet) tab.textContent = sheet.name;
      else say(tab, "text", "chartAllSheets");
      const isShown = at === (only ?? -1) + 1;
      tab.setAttribute("aria-selected", String(isShown));
      tab.tabIndex = isShown ? 0 : -1;
    }
  }

  private tab(at: number): HTMLElement {
    const tab = h("button", {
      attributes: { type: "button", role: "tab", id: newId() },
      on: { click: () => this.chosen(at === 0 ? null : at - 1) },
    });
    this.element.append(tab);
    return tab;
  }
}

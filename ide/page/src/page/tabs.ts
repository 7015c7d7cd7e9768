// Tabs with their panels; arrow keys move between them.
import { h, newId, say } from "./dom";
import type { Key } from "../text/language";

export interface Panel {
  /** Its name for other parts of the page. */
  id: string;
  text: Key;
  element: HTMLElement;
  /** Is told when it can be seen, and when no longer. */
  shown?: (isShown: boolean) => void;
}

export class Tabs {
  readonly element: HTMLElement;
  private buttons = new Map<string, HTMLButtonElement>();
  private current = "";
  private listeners: ((id: string) => void)[] = [];

  constructor(
    label: Key,
    private panels: Panel[],
  ) {
    const list = h("div", { class: "tabs", label, attributes: { role: "tablist" } });
    this.element = h("div", { class: "tabbed" }, list);
    for (const panel of panels) {
      list.append(this.tab(panel));
      this.element.append(panel.element);
    }
    list.addEventListener("keydown", (event) => moveInTabs(event, list));
  }

  private tab({ id, text, element }: Panel): HTMLElement {
    const tab = h(
      "button",
      {
        attributes: {
          type: "button",
          role: "tab",
          id: newId(),
          "aria-selected": "false",
          tabindex: -1,
        },
        on: { click: () => this.show(id) },
      },
      h("span", { text }),
    );
    say(tab, "aria-label", text);
    element.id = newId();
    element.hidden = true;
    element.classList.add("panel");
    element.setAttribute("role", "tabpanel");
    element.setAttribute("aria-labelledby", tab.id);
    element.tabIndex = 0;
    tab.setAttribute("aria-controls", element.id);
    this.buttons.set(id, tab);
    return tab;
  }

  /** Shows a panel; an unknown name changes nothing. */
  show(id: string, focus = false): void {
    if (this.buttons.has(id) && id !== this.current) {
      this.current = id;
      for (const panel of this.panels) this.setShown(panel, panel.id === id);
      for (const listener of this.listeners) listener(id);
    }
    if (focus) this.buttons.get(id)?.focus();
  }

  private setShown(panel: Panel, isShown: boolean): void {
    const was = !panel.element.hidden;
    const tab = this.buttons.get(panel.id);
    panel.element.hidden = !isShown;
    tab?.setAttribute("aria-selected", String(isShown));
    if (tab) tab.tabIndex = isShown ? 0 : -1;
    if (was !== isShown) panel.shown?.(isShown);
  }

  /** The panel that can be seen. */
  get shown(): string {
    return this.current;
  }

  /** By its place, from 0. */
  showAt(index: number): void {
    const panel = this.panels[index];
    if (panel) this.show(panel.id, true);
  }

  onShown(listener: (id: string) => void): void {
    this.listeners.push(listener);
  }

  /** A number beside a tab; empty for none. */
  badge(id: string, text: string, kind: "" | "bad" | "good" = ""): void {
    const tab = this.buttons.get(id);
    if (!tab) return;
    // It is drawn by the style sheet: a tab's name does not change with what is in its panel.
    if (text === "") delete tab.dataset["badge"];
    else tab.dataset["badge"] = text;
    tab.dataset["kind"] = kind;
  }
}

/** Arrow keys, Home and End in a list of tabs. */
export function moveInTabs(event: KeyboardEvent, list: HTMLElement): void {
  const tabs = [...list.querySelectorAll<HTMLElement>("[role=tab]")];
  const at = tabs.indexOf(document.activeElement as HTMLElement);
  const goals: Record<string, number> = {
    ArrowRight: (at + 1) % tabs.length,
    ArrowLeft: (at + tabs.length - 1) % tabs.length,
    Home: 0,
    End: tabs.length - 1,
  };
  const goal = goals[event.key];
  if (at < 0 || goal === undefined) return;
  event.preventDefault();
  tabs[goal]?.focus();
  tabs[goal]?.click();
}

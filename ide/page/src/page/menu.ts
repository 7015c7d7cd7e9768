// A menu that opens at an element and closes after a choice, with Escape, or by a click elsewhere.
import { h } from "./dom";

export interface MenuItem {
  text: string;
  act: () => void;
  /** Words beside it: a shortcut. */
  hint?: string;
  checked?: boolean;
  disabled?: boolean;
  /** Why it cannot be chosen now; it can still be reached, to be read. */
  why?: string;
}

/** Groups of items; a line is drawn between groups. */
export type MenuGroups = MenuItem[][];

let close: (() => void) | undefined;

/** Opens a menu below an element; where it was opened before, closes it. */
export function openMenu(at: Element, groups: MenuGroups): void {
  const wasHere = at.getAttribute("aria-expanded") === "true";
  close?.();
  if (wasHere) return;
  const before = document.activeElement;
  const menu = h("div", { class: "menu", attributes: { role: "menu" } });
  const end = (act?: () => void) => {
    close = undefined;
    menu.remove();
    if (at.hasAttribute("aria-expanded")) at.setAttribute("aria-expanded", "false");
    removeEventListener("pointerdown", outside, true);
    removeEventListener("resize", resized);
    // Not with what it scrolls to: in an editor that is the cursor, and not what is looked at.
    if ((before instanceof HTMLElement || before instanceof SVGElement) && before.isConnected)
      before.focus({ preventScroll: true });
    act?.();
  };
  const outside = (event: Event) => {
    if (!menu.contains(event.target as Node) && !at.contains(event.target as Node)) end();
  };
  const resized = () => end();
  for (const [index, group] of groups.filter((group) => group.length > 0).entries()) {
    if (index > 0) menu.append(h("div", { class: "line", attributes: { role: "separator" } }));
    menu.append(...group.map((item) => itemElement(item, end)));
  }
  menu.addEventListener("keydown", (event) => keys(event, menu, end));
  (at.closest("header, main") ?? document.body).append(menu);
  place(menu, at.getBoundingClientRect());
  if (at.hasAttribute("aria-expanded")) at.setAttribute("aria-expanded", "true");
  addEventListener("pointerdown", outside, true);
  addEventListener("resize", resized);
  close = end;
  itemsOf(menu)[0]?.focus();
}

function itemElement(item: MenuItem, end: (act: () => void) => void): HTMLElement {
  const isChoice = item.checked !== undefined;
  return h(
    "button",
    {
      class: "item",
      attributes: {
        type: "button",
        role: isChoice ? "menuitemradio" : "menuitem",
        "aria-checked": isChoice ? String(item.checked) : undefined,
        "aria-disabled": item.why !== undefined && "true",
        title: item.why,
        tabindex: -1,
      },
      set: { disabled: item.disabled ?? false },
      on: { click: () => item.why === undefined && end(item.act) },
    },
    h("span", {}, item.text),
    item.hint && h("kbd", { attributes: { "aria-hidden": "true" } }, item.hint),
  );
}

function itemsOf(menu: HTMLElement): HTMLElement[] {
  return [...menu.querySelectorAll<HTMLElement>(".item:not(:disabled)")];
}

function keys(event: KeyboardEvent, menu: HTMLElement, end: () => void): void {
  const items = itemsOf(menu);
  const at = items.indexOf(document.activeElement as HTMLElement);
  const goals: Record<string, number> = {
    ArrowDown: (at + 1) % items.length,
    ArrowUp: (at + items.length - 1) % items.length,
    Home: 0,
    End: items.length - 1,
  };
  const goal = goals[event.key];
  if (goal !== undefined) items[goal]?.focus();
  else if (event.key === "Escape" || event.key === "Tab") end();
  else return;
  event.preventDefault();
  event.stopPropagation();
}

/** Below the element, and within the window. */
function place(menu: HTMLElement, at: DOMRect): void {
  const { width, height } = menu.getBoundingClientRect();
  const below = at.bottom + height <= innerHeight ? at.bottom : Math.max(0, at.top - height);
  menu.style.left = `${Math.max(4, Math.min(at.left, innerWidth - width - 4))}px`;
  menu.style.top = `${Math.max(4, Math.min(below, innerHeight - height - 4))}px`;
}

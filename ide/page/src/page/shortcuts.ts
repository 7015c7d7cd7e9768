// Keys of the whole page; those of the editor are in editor/commands.ts.
import type { Editors } from "../editor/editors";
import type { Header } from "./header";
import { help } from "./help";
import type { ProjectMenu } from "./project_menu";
import type { Tabs } from "./tabs";

interface Parts {
  header: Header;
  tabs: Tabs;
  menu: ProjectMenu;
  editors: Editors;
  search: () => void;
}

/** Parts of the page that F6 goes round, with what gets the focus in each. */
const REGIONS = ["header", ".sidebar:not(.away)", ".pane", ".panels"];
const FIRST = ".cm-content, [role=tab][aria-selected=true], [aria-current]";
const FOCUSABLE = "button:not(:disabled), select, input, [tabindex='0'], .cm-content";

/** Listens from now on. */
export function shortcuts({ header, tabs, menu, search }: Parts): void {
  const keys: Record<string, () => void> = {
    F1: help,
    F9: () => header.act("run"),
    "Shift+F9": () => header.act("stop"),
    "Ctrl+F9": () => header.act("pause"),
    F10: () => header.act("singleScan"),
    F6: () => nextRegion(1),
    "Shift+F6": () => nextRegion(-1),
    "Ctrl+S": () => void menu.save(),
    "Ctrl+Shift+F": search,
  };
  addEventListener("keydown", (event) => {
    const panel = /^Digit(\d)$/.exec(event.code);
    const act = event.altKey
      ? panel && !event.ctrlKey && (() => tabs.showAt((Number(panel[1]) + 9) % 10))
      : keys[keyName(event)];
    // A dialog has the page for itself.
    if (!act || document.querySelector("dialog[open]")) return;
    event.preventDefault();
    act();
  });
}

function keyName(event: KeyboardEvent): string {
  const parts = [];
  if (event.ctrlKey || event.metaKey) parts.push("Ctrl");
  if (event.shiftKey) parts.push("Shift");
  return [...parts, event.key.length === 1 ? event.key.toUpperCase() : event.key].join("+");
}

function nextRegion(step: 1 | -1): void {
  const regions = REGIONS.flatMap((name) => [...document.querySelectorAll<HTMLElement>(name)]);
  const at = regions.findIndex((region) => region.contains(document.activeElement));
  const next = regions[(at + step + regions.length) % regions.length];
  const inside = (what: string) =>
    [...(next?.querySelectorAll<HTMLElement>(what) ?? [])].find((one) => one.offsetParent !== null);
  const goal = inside(FIRST) ?? inside(FOCUSABLE);
  goal?.focus();
}

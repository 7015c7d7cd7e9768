// Light or dark: as the system has it, or as somebody chose.
import { store, storedText } from "../project/stored";

export const THEMES = ["system", "light", "dark"] as const;
export type Theme = (typeof THEMES)[number];

const STORED = "uno200.theme";
const listeners: (() => void)[] = [];
const system = matchMedia("(prefers-color-scheme: dark)");

/** What was chosen. */
export function theme(): Theme {
  return THEMES.find((theme) => theme === storedText(STORED)) ?? "system";
}

export function setTheme(theme: Theme): void {
  store(STORED, theme);
  show();
}

/** Is told when colours are other ones: canvases do not see style sheets. */
export function onTheme(listener: () => void): void {
  listeners.push(listener);
}

/** A colour of the style sheet, by its name there. */
export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

function show(): void {
  const isDark = theme() === "system" ? system.matches : theme() === "dark";
  document.documentElement.dataset["theme"] = isDark ? "dark" : "light";
  for (const listener of listeners) listener();
}

system.addEventListener("change", show);
show();

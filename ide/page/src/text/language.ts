// Which language the page speaks, and its words from the table.
import { TABLE } from "./table";
import { store, storedText } from "../project/stored";

export const LANGUAGES = ["en", "de", "es"] as const;
export type Language = (typeof LANGUAGES)[number];
export type Key = keyof typeof TABLE;
export type Args = (string | number)[];

const STORED = "uno200.language";
const listeners: (() => void)[] = [];
let index = LANGUAGES.indexOf(stored());

function stored(): Language {
  const value = storedText(STORED);
  return LANGUAGES.find((language) => language === value) ?? "en";
}

/** The language that is chosen. */
export function language(): Language {
  return LANGUAGES[index] ?? "en";
}

/** Chooses a language, for this time and the next ones. */
export function setLanguage(language: Language): void {
  index = LANGUAGES.indexOf(language);
  store(STORED, language);
  document.documentElement.lang = language;
  for (const listener of listeners) listener();
}

/** Is told when another language was chosen. */
export function onLanguage(listener: () => void): void {
  listeners.push(listener);
}

/** The words for a key; `{0}` and so on are replaced by `args`. */
export function t(key: Key, ...args: Args): string {
  const words = TABLE[key][index] ?? TABLE[key][0];
  return words.replace(/\{(\d)\}/g, (_, number: string) => String(args[Number(number)] ?? ""));
}

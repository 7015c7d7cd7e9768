// Which language the page speaks, and its words from the table.
import type { CHART_WORDS } from "./chart_words";
import type { DIAGRAM_WORDS } from "./diagram_words";
import type { DRAWING_WORDS } from "./drawing_words";
import type { EVENT_WORDS } from "./event_words";
import type { STEP_WORDS } from "./step_words";
import type { SWEEP_WORDS } from "./sweep_words";
import { TABLE } from "./table";
import { store, storedText } from "../project/stored";

export const LANGUAGES = ["en", "de", "es"] as const;
export type Language = (typeof LANGUAGES)[number];
export type Key =
  | keyof typeof TABLE
  | keyof typeof CHART_WORDS
  | keyof typeof DIAGRAM_WORDS
  | keyof typeof DRAWING_WORDS
  | keyof typeof EVENT_WORDS
  | keyof typeof STEP_WORDS
  | keyof typeof SWEEP_WORDS;
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

/** Words that come from a file, in the languages in their order. */
export type Words = readonly [string, string, string];

/** Those in the language that is chosen. */
export function inLanguage(words: Words): string {
  return words[index] ?? words[0];
}

const table: Partial<Record<Key, Words>> = { ...TABLE };

/** Words of a part of the page that comes later. */
export function addWords(words: Partial<Record<Key, Words>>): void {
  Object.assign(table, words);
}

/** The words for a key; `{0}` and so on are replaced by `args`. */
export function t(key: Key, ...args: Args): string {
  const row = table[key];
  return (row ? inLanguage(row) : "").replace(/\{(\d)\}/g, (_, number: string) =>
    String(args[Number(number)] ?? ""),
  );
}

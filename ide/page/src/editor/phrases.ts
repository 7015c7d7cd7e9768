// The editor's own words in the language of the page.
import { EditorState, type Extension } from "@codemirror/state";
import { t, type Key } from "../text/language";

/** The words of the library, and their keys in the table. */
const PHRASES: Record<string, Key> = {
  Find: "find",
  Replace: "replaceField",
  next: "findNext",
  previous: "findPrevious",
  all: "findAll",
  "match case": "matchCase",
  regexp: "matchRegexp",
  "by word": "matchWord",
  replace: "replaceOne",
  "replace all": "replaceAll",
  close: "close",
  "current match": "currentMatch",
  "on line": "onLine",
  "replaced $ matches": "replacedMatches",
  "replaced match on line $": "replacedOnLine",
  "Go to line": "goToLine",
  go: "go",
  Completions: "completions",
  Diagnostics: "diagnostics",
  "No diagnostics": "noDiagnostics",
};

/** For an editor, in the language that is chosen now. */
export function phrases(): Extension {
  const words = Object.entries(PHRASES).map(([phrase, key]) => [phrase, t(key)] as const);
  return EditorState.phrases.of(Object.fromEntries(words));
}

// Colours for Structured Text, and for charts, whose code it is: words alone. What a text means is
// the core's business.
import { StreamLanguage, type StringStream } from "@codemirror/language";
import { FUNCTIONS, KEYWORDS, OPERATORS, TYPES } from "./structured_words";

interface State {
  /** The ends of the comments that are open: they nest. */
  open: ("*)" | "*/" | "}")[];
}

/** A comment or pragma, up to its end or that of the line. */
function inside(stream: StringStream, { open }: State): string {
  const kind = open.includes("}") ? "meta" : "comment";
  while (!stream.eol() && open.length > 0) {
    const end = open[open.length - 1];
    if (end !== undefined && stream.match(end)) open.pop();
    else if (end !== "}" && stream.match("(*")) open.push("*)");
    else if (end !== "}" && stream.match("/*")) open.push("*/");
    else stream.next();
  }
  return kind;
}

function opened(stream: StringStream, state: State): string | null {
  if (stream.match(/^\/\/#.*/)) return "meta";
  if (stream.match(/^\/\/.*/)) return "comment";
  if (stream.match("(*")) state.open.push("*)");
  else if (stream.match("/*")) state.open.push("*/");
  else if (stream.match("{")) state.open.push("}");
  else return null;
  return inside(stream, state);
}

/** What charts have besides. */
const ELEMENTS = new Set(
  "INITIAL_STEP STEP END_STEP TRANSITION END_TRANSITION FROM PRIORITY ACTION END_ACTION".split(" "),
);
const NONE: ReadonlySet<string> = new Set();

function word(text: string, more: ReadonlySet<string>): string {
  const upper = text.toUpperCase();
  if (KEYWORDS.has(upper) || more.has(upper)) return "keyword";
  if (OPERATORS.has(upper)) return "operatorKeyword";
  if (TYPES.has(upper)) return "typeName";
  if (upper === "TRUE" || upper === "FALSE") return "number";
  if (FUNCTIONS.has(upper) || /^(?:[A-Z]+_)?TO_[A-Z]+$/.test(upper)) return "heading";
  return "propertyName";
}

function token(stream: StringStream, state: State, more: ReadonlySet<string>): string | null {
  if (state.open.length > 0) return inside(stream, state);
  if (stream.eatSpace()) return null;
  const comment = opened(stream, state);
  if (comment !== null) return comment;
  if (stream.match(/^'(?:\$.|[^'])*'?/) || stream.match(/^"(?:\$.|[^"])*"?/)) return "string";
  if (stream.match(/^%\w+(?:\.\d+)*/)) return "variableName";
  if (stream.match(/^\w+#[-+]?\w+(?:#\w+)?(?:\.\d+\w*)?/)) return "number";
  if (stream.match(/^\d[\d_]*(?:\.\d[\d_]*)?(?:E[-+]?\d+)?/i)) return "number";
  const found = stream.match(/^[\p{L}_][\p{L}\d_]*/u);
  if (found && found !== true) return word(found[0], more);
  stream.next();
  return null;
}

function language(name: string, more: ReadonlySet<string>): StreamLanguage<State> {
  return StreamLanguage.define<State>({
    name,
    startState: () => ({ open: [] }),
    copyState: ({ open }) => ({ open: [...open] }),
    token: (stream, state) => token(stream, state, more),
    languageData: { commentTokens: { line: "//", block: { open: "(*", close: "*)" } } },
  });
}

export const structuredText = language("structured-text", NONE);
export const charts = language("charts", ELEMENTS);

// Colours for AWL, scenarios and plants: words alone. What a text means is the core's business.
import { StreamLanguage, type StringStream } from "@codemirror/language";
import { MNEMONICS } from "./mnemonics";

const BLOCKS = new Set(
  (
    "NETWORK TITLE BEGIN VAR VAR_INPUT VAR_OUTPUT VAR_IN_OUT VAR_TEMP END_VAR DATA_BLOCK " +
    "END_DATA_BLOCK ORGANIZATION_BLOCK END_ORGANIZATION_BLOCK SUBROUTINE_BLOCK " +
    "END_SUBROUTINE_BLOCK INTERRUPT_BLOCK END_INTERRUPT_BLOCK"
  ).split(" "),
);
const ADDRESS = new RegExp(
  "^(?:SM|AI|AQ|AE|AA|[IQMSVLEA])[BWD]?\\d+(?:\\.[0-7])?\\b" +
    "|^(?:[TCZ]|HC|HZ|AC|Ain|SBR|INT)\\d+(?:\\.cv)?\\b",
  "i",
);
const NUMBER = /^(?:[A-Z]+#)?(?:16#[0-9A-F]+|2#[01_]+|[+-]?\d+(?:\.\d+)?(?:E[+-]?\d+)?)\b/i;
const WORD = /^[A-Z_Ä-Üß][\w.Ä-üß]*/i;

interface State {
  /** The end of the comment that began on a line before. */
  comment: "*)" | "*/" | null;
  /** Whether a mnemonic can come. */
  atStart: boolean;
}

function toEnd(stream: StringStream, state: State): string {
  const end = state.comment;
  if (end !== null && stream.skipTo(end)) {
    stream.match(end);
    state.comment = null;
  } else stream.skipToEnd();
  return "comment";
}

function opened(stream: StringStream, state: State): string | null {
  if (stream.match("//#")) {
    stream.skipToEnd();
    return "meta";
  }
  if (stream.match("//")) {
    stream.skipToEnd();
    return "comment";
  }
  if (stream.match("(*")) state.comment = "*)";
  else if (stream.match("/*")) state.comment = "*/";
  else return null;
  return toEnd(stream, state);
}

/** Mnemonics such as `LDW>=` and `+I`; a blank may be before the relation. */
const MNEMONIC = /^(?:[A-Z_]+\s*(?:<>|<=|>=|=|<|>)|[A-Z_]+|[-+*/=]I\b|[-+*/][RD]\b|=)/i;

function mnemonic(stream: StringStream): string | null {
  const found = stream.match(MNEMONIC, false);
  if (!found || found === true) return null;
  const word = found[0].toUpperCase().replace(/\s+/g, "");
  const rest = stream.string.slice(stream.pos + found[0].length);
  if (/^[\w.]/.test(rest) && /\w$/.test(found[0])) return null;
  const kind = MNEMONICS.has(word) ? "keyword" : BLOCKS.has(word) ? "heading" : null;
  if (kind) stream.match(MNEMONIC);
  return kind;
}

function operand(stream: StringStream): string | null {
  if (stream.match(/^"[^"]*"?/)) return "string";
  if (stream.match(/^'[^']*'?/)) return "string";
  if (stream.match(ADDRESS)) return "variableName";
  if (stream.match(NUMBER)) return "number";
  if (stream.match(/^(?:TRUE|FALSE|ON|OFF)\b/i)) return "number";
  if (stream.match(WORD)) return "propertyName";
  stream.next();
  return null;
}

export const awl = StreamLanguage.define<State>({
  name: "awl",
  startState: () => ({ comment: null, atStart: true }),
  token(stream, state) {
    if (state.comment !== null) return toEnd(stream, state);
    if (stream.sol()) state.atStart = true;
    if (stream.eatSpace()) return null;
    const comment = opened(stream, state);
    if (comment !== null) return comment;
    const kind = state.atStart ? mnemonic(stream) : null;
    state.atStart = false;
    return kind ?? operand(stream);
  },
  languageData: { commentTokens: { line: "//" } },
});

const STATEMENTS =
  /^(?:at|event|expect|run|scan|plant|program|goal|within|every|always|never|until|from|to|for|or|and|pulse|clock|receive|sent|times|reverse)\b/i;

const PARTS =
  /^(?:plant|outputs|part|belt|button|switch|slider|fault|count|move|approach|feed|hold|take|input|analog|draw|piece|if|and|or|not|stuck|slow|start|inverted)\b/i;

/** A language of lines that begin with such words, with comments after `#`. */
function lines(name: string, words: RegExp): StreamLanguage<object> {
  return StreamLanguage.define<object>({
    name,
    startState: () => ({}),
    token(stream) {
      if (stream.eatSpace()) return null;
      if (stream.match(/^#.*/)) return "comment";
      if (stream.match(words)) return "keyword";
      if (stream.match(/^\+?\d+(?:\.\d+)?(?:ms|s|min|h|k?Hz)\b/i)) return "string";
      return operand(stream);
    },
    languageData: { commentTokens: { line: "#" } },
  });
}

export const scenario = lines("scenario", STATEMENTS);
export const plant = lines("plant", PARTS);

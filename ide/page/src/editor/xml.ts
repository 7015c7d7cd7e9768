// Colours for XML, as function blocks of IEC 61499 are written in: tags, attributes, texts.
import { StreamLanguage } from "@codemirror/language";

interface State {
  /** What is open: a tag, or a comment. */
  inside: "tag" | "comment" | null;
}

export const xml = StreamLanguage.define<State>({
  name: "xml",
  startState: () => ({ inside: null }),
  token(stream, state) {
    if (state.inside === "comment") {
      if (stream.skipTo("-->")) {
        stream.match("-->");
        state.inside = null;
      } else stream.skipToEnd();
      return "comment";
    }
    if (stream.eatSpace()) return null;
    if (state.inside === null) {
      if (stream.match("<!--")) {
        state.inside = "comment";
        return "comment";
      }
      if (stream.match(/^<[?!][^>]*>?/)) return "meta";
      if (stream.match(/^<\/?[\w:.-]*/)) {
        state.inside = "tag";
        return "keyword";
      }
      if (!stream.match(/^[^<]+/)) stream.next();
      return null;
    }
    if (stream.match(/^\/?>/)) {
      state.inside = null;
      return "keyword";
    }
    if (stream.match(/^"[^"]*"?/) || stream.match(/^'[^']*'?/)) return "string";
    if (stream.match(/^[\w:.-]+/)) return "typeName";
    stream.next();
    return null;
  },
  languageData: { commentTokens: { block: { open: "<!--", close: "-->" } } },
});

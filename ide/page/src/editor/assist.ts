// What the core knows about a place in a text: completion, hover.
import {
  autocompletion,
  snippet,
  type Completion as Entry,
  type CompletionContext,
  type CompletionResult,
} from "@codemirror/autocomplete";
import type { Extension } from "@codemirror/state";
import { hoverTooltip } from "@codemirror/view";
import type { Core } from "../core/core";
import type { Completion } from "../core/protocol";
import { markdown } from "./markdown";

/** Kinds of the core as the editor has pictures for them. */
const PICTURES: Record<string, string> = {
  instruction: "keyword",
  symbol: "variable",
  address: "constant",
  directive: "namespace",
  routine: "function",
  keyword: "type",
};

/** A text with holes as the editor writes it; after the last one it goes on. */
function withHoles(text: string, holes: number[]): string {
  const ends = [...holes, text.length];
  const starts = [0, ...holes];
  return ends.map((end, at) => `${text.slice(starts[at], end)}\${}`).join("");
}

function entry(completion: Completion): Entry {
  const { label, detail, info, kind, insert, holes } = completion;
  const type = PICTURES[kind];
  const apply = holes.length > 0 ? snippet(withHoles(insert, holes)) : insert;
  return {
    label,
    apply,
    ...(detail ? { detail } : {}),
    ...(info ? { info: () => markdown(info) } : {}),
    ...(type ? { type } : {}),
  };
}

/** Completion and hover for a file. */
export function assist(core: Core, file: string): Extension {
  const complete = async (context: CompletionContext): Promise<CompletionResult | null> => {
    if (!context.explicit && !context.matchBefore(/[\w#*.%(]$/)) return null;
    const found = await core.ask({ do: "complete", file, at: context.pos }).catch(() => []);
    const from = found[0]?.from;
    if (from === undefined) return null;
    return {
      from,
      options: found.filter((one) => one.from === from).map(entry),
      validFor: /^\w*$/,
    };
  };
  const hover = hoverTooltip(async (_view, at) => {
    const found = await core.ask({ do: "hover", file, at }).catch(() => null);
    if (!found) return null;
    const { from, to, text } = found;
    return { pos: from, end: to, above: true, create: () => ({ dom: markdown(text) }) };
  });
  // Nothing is selected by itself: Enter after `T3` must not make it T37. Tab takes the first one.
  const options = { override: [complete], activateOnTypingDelay: 60, selectOnOpen: false };
  return [autocompletion(options), hover];
}

// What the core knows about a place in a text: completion, hover.
import {
  autocompletion,
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
  keyword: "type",
};

function entry(completion: Completion): Entry {
  const { label, detail, info, kind } = completion;
  const type = PICTURES[kind];
  return {
    label,
    ...(detail ? { detail } : {}),
    ...(info ? { info: () => markdown(info) } : {}),
    ...(type ? { type } : {}),
  };
}

/** Completion and hover for a file. */
export function assist(core: Core, file: string): Extension {
  const complete = async (context: CompletionContext): Promise<CompletionResult | null> => {
    if (!context.explicit && !context.matchBefore(/[\w#*.]$/)) return null;
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

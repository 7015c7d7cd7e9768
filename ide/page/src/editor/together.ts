// A change of several files at once, such as renaming a symbol: where it is undone or redone in one
// of them it is in the others, too. In a file that was changed after it, it stays.
import { invertedEffects, redo, undo } from "@codemirror/commands";
import { StateEffect, type EditorState, type Extension, type Transaction } from "@codemirror/state";

/** Marks what belongs together; the history gives the mark back when it is undone. */
const together = StateEffect.define<number>();
let last = 0;

/** What each editor has for it. */
export const rememberTogether: Extension = invertedEffects.of((transaction) =>
  transaction.effects.filter((effect) => effect.is(together)),
);

/** A mark for the transactions of one change. */
export function mark(): StateEffect<number> {
  last += 1;
  return together.of(last);
}

/** What a transaction has undone or redone of a change of several files. */
export interface Part {
  id: number;
  isUndo: boolean;
}

export function partOf(transaction: Transaction): Part | null {
  const isUndo = transaction.isUserEvent("undo");
  if (!isUndo && !transaction.isUserEvent("redo")) return null;
  const effect = transaction.effects.find((effect) => effect.is(together));
  return effect ? { id: effect.value as number, isUndo } : null;
}

/** The transaction that does the same in another file, if it comes next there. */
export function samePart(state: EditorState, { id, isUndo }: Part): Transaction | null {
  let next: Transaction | null = null;
  const dispatch = (transaction: Transaction) => (next = transaction);
  (isUndo ? undo : redo)({ state, dispatch });
  return next !== null && partOf(next)?.id === id ? next : null;
}

// Where arrow keys lead in a chart: along its lines, beside, and through the actions of a step.
import type { Drawn, Item } from "./drawn";

/** An element, or an action in the block of a step. */
export interface Spot {
  item: Item;
  action: number | null;
}

/** So far beside each other elements are in one row. */
const ROW = 40;

/** Where a key leads; nothing if there is nothing. */
export function next(drawn: Drawn, from: Spot, key: string): Spot | undefined {
  const inBlock = withinBlock(from, key);
  if (inBlock) return inBlock;
  const items = drawn.ofSheet(from.item.sheet);
  const item = beyond(items, from.item, key);
  return item && { item, action: null };
}

function withinBlock({ item, action }: Spot, key: string): Spot | undefined {
  if (item.kind !== "step") return undefined;
  const count = item.element.actions.length;
  if (action === null) return key === "ArrowRight" && count > 0 ? { item, action: 0 } : undefined;
  if (key === "ArrowLeft") return { item, action: null };
  if (key === "ArrowDown") return { item, action: Math.min(action + 1, count - 1) };
  if (key === "ArrowUp")
    return action === 0 ? { item, action: null } : { item, action: action - 1 };
  return undefined;
}

function beyond(items: Item[], item: Item, key: string): Item | undefined {
  const at = items.indexOf(item);
  if (key === "ArrowDown") return leftmost(neighbours(items, item, true));
  if (key === "ArrowUp") return leftmost(neighbours(items, item, false));
  if (key === "ArrowRight") return beside(items, item, 1);
  if (key === "ArrowLeft") return beside(items, item, -1);
  if (key === "Home") return items[0];
  if (key === "End") return items.filter(({ kind }) => kind === "step").at(-1);
  if (key === "PageDown") return items[at + 1];
  if (key === "PageUp") return items[at - 1];
  return undefined;
}

/** What lines lead to from an element, or come to it from. */
function neighbours(items: Item[], item: Item, isDown: boolean): Item[] {
  if (item.kind === "transition") {
    const ids = isDown ? item.element.to : item.element.from;
    return items.filter((one) => ids.includes(one.id));
  }
  return items.filter(
    (one) =>
      one.kind === "transition" && (isDown ? one.element.from : one.element.to).includes(item.id),
  );
}

function leftmost(items: Item[]): Item | undefined {
  return items.toSorted((a, b) => a.middle[0] - b.middle[0])[0];
}

/** The nearest one of the same kind in the row. */
function beside(items: Item[], item: Item, side: 1 | -1): Item | undefined {
  const away = (one: Item) => side * (one.middle[0] - item.middle[0]);
  const row = items.filter(
    (one) =>
      one.kind === item.kind && away(one) > 0 && Math.abs(one.middle[1] - item.middle[1]) < ROW,
  );
  return row.toSorted((a, b) => away(a) - away(b))[0];
}

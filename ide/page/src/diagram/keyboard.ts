// Keys in a diagram: along the order of execution, and what is done with an element.
import type { Point } from "../page/ground";
import { goalOf } from "../page/walk";
import type { Item } from "./sheets";

/** So far a key moves an element. */
const MOVED = 20;
const ARROWS: Record<string, Point> = {
  ArrowLeft: [-MOVED, 0],
  ArrowRight: [MOVED, 0],
  ArrowUp: [0, -MOVED],
  ArrowDown: [0, MOVED],
};

/** What keys do. */
export interface Acts {
  /** `isMore`: beside what is chosen. */
  choose(item: Item | undefined, isMore?: boolean): void;
  chooseAll(): void;
  goToText(item: Item): void;
  move(by: Point): void;
  remove(): void;
  group(): void;
  rename(): void;
  goBack(isUndo: boolean): void;
  addBlock(): void;
}

/** Does what a key says; whether it said something. */
export function pressed(
  event: KeyboardEvent,
  items: Item[],
  focus: Item | undefined,
  acts: Acts,
): boolean {
  const isHeld = event.ctrlKey || event.metaKey;
  if (event.altKey) return false;
  if (isHeld) return withControl(event, focus, acts);
  const next = neighbour(event.key, items, focus);
  if (next) acts.choose(next, event.shiftKey);
  else if (event.key === "Enter" || event.key === " ") acts.choose(focus);
  else if (event.key === "Escape") acts.choose(undefined);
  else if (event.key === "Insert") acts.addBlock();
  else if (event.key === "F12" && focus) acts.goToText(focus);
  else if (event.key === "F2") acts.rename();
  else if (event.key === "Delete" || event.key === "Backspace") acts.remove();
  else return false;
  return true;
}

function withControl(event: KeyboardEvent, focus: Item | undefined, acts: Acts): boolean {
  const by = ARROWS[event.key];
  const key = event.key.toLowerCase();
  if (by) acts.move(by);
  else if (key === "a") acts.chooseAll();
  else if (key === " ") acts.choose(focus, true);
  else if (key === "g") acts.group();
  else if (key === "z") acts.goBack(!event.shiftKey);
  else if (key === "y") acts.goBack(false);
  else return false;
  return true;
}

/** The element that an arrow leads to. */
function neighbour(key: string, items: Item[], focus: Item | undefined): Item | undefined {
  const inOrder = items.toSorted(
    (one, other) => one.sheet - other.sheet || one.element.order - other.element.order,
  );
  const at = inOrder.findIndex((item) => item === focus);
  const goal = goalOf(key, at, inOrder.length);
  return goal === undefined ? undefined : (inOrder[goal] ?? focus);
}

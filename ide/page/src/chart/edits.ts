// What edits mean for what is selected: an edit, or why there is none. Whether the chart allows it,
// the module of charts says.
import type { Key } from "../text/language";
import type { Drawn, Item, Point, StepItem } from "./drawn";
import type { Edit, ElementId } from "./protocol";

/** A drawing with what is selected in it. */
export interface Scene {
  drawn: Drawn;
  sheet: number;
  /** In the order in which they were selected. */
  items: Item[];
  /** What has the focus; it is selected unless nothing is. */
  focus: Item | null;
  /** The number of the action that is selected, in the block of `focus`. */
  action: number | null;
}

export type Meaning = { edit: Edit } | { why: Key };

export type EditName = keyof typeof MEANINGS;

function one(scene: Scene, edit: (item: Item) => Edit): Meaning {
  const [item, other] = scene.items;
  return item && !other ? { edit: edit(item) } : { why: "chartSelectOne" };
}

function steps({ items }: Scene): StepItem[] {
  return items.filter((item) => item.kind === "step");
}

const branch = (isParallel: boolean) => (scene: Scene) =>
  one(scene, ({ id: of }) => ({ addBranch: { of, isParallel } }));

function connect(scene: Scene): Meaning {
  const ids = steps(scene).map(({ id }) => id);
  const last = ids.pop();
  if (last === undefined || ids.length === 0) return { why: "chartSelectSteps" };
  return { edit: { connect: { from: ids, to: [last] } } };
}

function initial(scene: Scene): Meaning {
  const [step, other] = steps(scene);
  if (!step || other) return { why: "chartSelectStep" };
  return { edit: { setInitial: { step: step.id, isInitial: !step.element.isInitial } } };
}

function erase({ items, focus, action }: Scene): Meaning {
  if (focus && action !== null)
    return { edit: { removeAction: { step: focus.id, index: action } } };
  if (items.length === 0) return { why: "chartSelectSome" };
  return { edit: { erase: { elements: items.map(({ id }) => id) } } };
}

const moveAction =
  (by: 1 | -1) =>
  ({ focus, action }: Scene): Meaning => {
    const count = focus?.kind === "step" ? focus.element.actions.length : 0;
    const to = (action ?? 0) + by;
    if (!focus || action === null) return { why: "chartSelectAction" };
    if (to < 0 || to >= count) return { why: "chartNothingBeyond" };
    return { edit: { moveAction: { step: focus.id, index: action, to } } };
  };

/** The number in its block of the action that an edit was about, after it. */
export function actionOf(edit: Edit | undefined): number | null {
  if (!edit) return null;
  if ("moveAction" in edit) return edit.moveAction.to;
  if ("setAction" in edit) return edit.setAction.index;
  return "removeAction" in edit ? edit.removeAction.index : null;
}

/** Puts elements where their middles are to be in the drawing. */
export function place(drawn: Drawn, sheet: number, middles: [ElementId, Point][]): Edit {
  const [x, y] = drawn.sheet(sheet)?.origin ?? [0, 0];
  const moved = middles.map(([id, at]): [ElementId, [number, number]] => [
    id,
    [Math.round(at[0] - x), Math.round(at[1] - y)],
  ]);
  return { place: { elements: moved } };
}

/** Where the middles of elements are when they are moved. */
export function shift(items: Item[], [dx, dy]: Point): [ElementId, Point][] {
  return items.map(({ id, middle: [x, y] }) => [id, [x + dx, y + dy]]);
}

function align(scene: Scene, moved: (step: StepItem, all: StepItem[]) => Point): Meaning {
  const all = steps(scene);
  if (all.length < 2) return { why: "chartSelectSteps" };
  const middles = all.map((step): [ElementId, Point] => [step.id, moved(step, all)]);
  return { edit: place(scene.drawn, scene.sheet, middles) };
}

const alignLeft = (scene: Scene) =>
  align(scene, ({ element, middle }, all) => {
    const left = Math.min(...all.map((step) => step.element.frame[0]));
    return [left + element.frame[2] / 2, middle[1]];
  });

const alignTop = (scene: Scene) =>
  align(scene, ({ element, middle }, all) => {
    const top = Math.min(...all.map((step) => step.element.frame[1]));
    return [middle[0], top + element.frame[3] / 2];
  });

const MEANINGS = {
  after: (scene: Scene) => one(scene, ({ id: of }) => ({ addAfter: { of } })),
  before: (scene: Scene) => one(scene, ({ id: of }) => ({ addBefore: { of } })),
  parallel: branch(true),
  alternative: branch(false),
  alone: ({ drawn, sheet }: Scene): Meaning => {
    const isInitial = (drawn.sheet(sheet)?.steps.length ?? 0) === 0;
    return { edit: { addStep: { at: null, isInitial } } };
  },
  connect,
  initial,
  erase,
  actionUp: moveAction(-1),
  actionDown: moveAction(1),
  alignLeft,
  alignTop,
  layout: (): Meaning => ({ edit: { layout: {} } }),
};

/** All edits that a selection is enough for. */
export const EDITS = Object.keys(MEANINGS) as EditName[];

export function meaning(name: EditName, scene: Scene): Meaning {
  return MEANINGS[name](scene);
}

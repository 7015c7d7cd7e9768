// What can be done with a diagram, each as one change of its text. What is refused is told.
import { tellRefusal } from "../drawings/module";
import { meet, type Frame, type Point } from "../page/ground";
import type { DiagramDocument } from "./document";
import type { DiagramEdit } from "./protocol";
import type { Item } from "./sheets";

/** Elements are moved and put in steps of so much. */
const GRID = 20;
/** What a new element needs: its box, and on the left of it what is given to its inputs. */
const ROOM = { before: 100, width: 140, height: 110 };

export class Edits {
  constructor(
    private document: DiagramDocument,
    /** Is told the keys of elements that are new. */
    private made: (keys: string[]) => void,
  ) {}

  /** Whether it could be done. */
  async perform(sheet: number, edit: DiagramEdit): Promise<boolean> {
    try {
      const made = await this.document.edit(sheet, edit);
      if (made.length > 0) this.made(made.map((id) => `${sheet}:${id}`));
      return true;
    } catch (error) {
      tellRefusal(error);
      return false;
    }
  }

  /** Moves elements of one diagram. */
  async move(items: Item[], by: Point): Promise<void> {
    const [first] = items;
    if (first) await this.perform(first.sheet, { move: { elements: idsOf(items), by } });
  }

  /** Takes elements of one diagram out. */
  async remove(items: Item[]): Promise<void> {
    const [first] = items;
    if (first) await this.perform(first.sheet, { remove: { elements: idsOf(items) } });
  }

  /** Puts elements of one diagram into a group; into none where its name is empty. */
  async group(items: Item[], name: string): Promise<void> {
    const [first] = items;
    if (first) await this.perform(first.sheet, { group: { elements: idsOf(items), name } });
  }

  comment({ sheet, element }: Item, comment: string): Promise<boolean> {
    return this.perform(sheet, { comment: { element: element.id, comment } });
  }

  paste(sheet: number, text: string): Promise<boolean> {
    return this.perform(sheet, { paste: { text, by: [2 * GRID, 2 * GRID] } });
  }

  /** Gives an input a value; none where it is empty. */
  give({ sheet, element }: Item, input: string, value: string): Promise<boolean> {
    return this.perform(sheet, { give: { element: element.id, input, value } });
  }

  set({ sheet, element }: Item, parameter: string, value: string): Promise<boolean> {
    return this.perform(sheet, { set: { element: element.id, parameter, value } });
  }
}

export function idsOf(items: Item[]): string[] {
  return items.map(({ element }) => element.id);
}

/** A distance in steps. */
export function snapped([x, y]: Point): Point {
  return [Math.round(x / GRID) * GRID, Math.round(y / GRID) * GRID];
}

/** What an output is called where its value is taken. */
export function nameOf({ element }: Item, output: number): string {
  const pin = element.outputs[output]?.name ?? "";
  return pin === "" ? element.fullName : `${element.fullName}.${pin}`;
}

/** A free place for a new element: in what can be seen and no higher than the others, otherwise below
 * everything. */
export function freePlace(items: Item[], [left, top, width, height]: Frame): Point {
  const rooms = items.map(({ element }) => element.room);
  const isFree = (frame: Frame) => !rooms.some((room) => meet(room, frame));
  const heights = items.map(({ element }) => element.frame[1]);
  const highest = items.length > 0 ? Math.min(...heights) : top;
  const first = Math.max(top + 2 * GRID, highest);
  const begin = left + ROOM.before;
  for (let y = first; y < top + height - ROOM.height; y += GRID)
    for (let x = begin; x + ROOM.width <= left + width; x += 2 * GRID)
      if (isFree([x - ROOM.before, y - GRID, ROOM.before + ROOM.width, ROOM.height])) return [x, y];
  const bottom = Math.max(top, ...rooms.map(([, y, , height]) => y + height));
  return [begin, bottom + 2 * GRID];
}

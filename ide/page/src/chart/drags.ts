// What a drag does: moves the ground, draws a band that selects, moves what is selected, draws a
// line to the step that is to be connected.
import { setAttributes, s } from "../page/dom";
import { meet, type Point } from "../page/ground";
import type { Item } from "./drawn";
import { place, shift } from "./edits";
import type { ChartEditor } from "./editor";
import type { Frame } from "./protocol";
import type { Shape } from "./shape";

export interface Drag {
  /** Whether the ground moves on while it is held at the edge. */
  isScrolling: boolean;
  move(event: PointerEvent): void;
  /** It is over: here, or, for null, without an effect. */
  end(event: PointerEvent | null): void;
}

/** Places are multiples of this, unless Alt is held. */
const GRID = 10;

/** Moves the ground. */
export function pan({ canvas: { element } }: ChartEditor, from: PointerEvent): Drag {
  const { scrollLeft, scrollTop } = element;
  return {
    isScrolling: false,
    move: ({ clientX, clientY }) => {
      element.scrollLeft = scrollLeft - (clientX - from.clientX);
      element.scrollTop = scrollTop - (clientY - from.clientY);
    },
    end: () => {},
  };
}

function between([x, y]: Point, [endX, endY]: Point): Frame {
  return [Math.min(x, endX), Math.min(y, endY), Math.abs(endX - x), Math.abs(endY - y)];
}

/** Selects what is in a band; with Shift that comes to what is selected. */
export function band(editor: ChartEditor, from: PointerEvent): Drag {
  const { canvas, selection } = editor;
  const begin = canvas.point(from);
  const rect = s("rect", { class: "band" });
  return {
    isScrolling: true,
    move: (event) => {
      const [x, y, width, height] = between(begin, canvas.point(event));
      setAttributes(rect, { x, y, width, height });
      if (!rect.isConnected) canvas.overlay.append(rect);
    },
    end: (event) => {
      rect.remove();
      if (!event) return;
      const frame = between(begin, canvas.point(event));
      const items = (editor.scene?.drawn.items ?? []).filter(
        (item) => (editor.only ?? item.sheet) === item.sheet && meet(core(item), frame),
      );
      if (!event.shiftKey) selection.clear();
      selection.add(items);
      editor.focus(false);
    },
  };
}

/** What a band has to reach of an element. */
function core(item: Item): Frame {
  if (item.kind === "step") return item.element.frame;
  const [x, y, endX, endY] = item.element.bar;
  return between([x, y], [endX, endY]);
}

/** Moves what is selected, in the chart that it is in; lines follow when it is dropped. */
export function move(editor: ChartEditor, from: PointerEvent): Drag {
  const { canvas, scene } = editor;
  const { reading } = editor.document;
  const begin = canvas.point(from);
  const items = scene?.items ?? [];
  const [atX, atY] = scene?.drawn.sheet(scene.sheet)?.origin ?? [0, 0];
  const main = editor.canvas.at(from.target)?.item ?? items[0];
  const by = (event: PointerEvent): Point => {
    const [x, y] = canvas.point(event);
    const [dx, dy] = [x - begin[0], y - begin[1]];
    if (event.altKey || !main) return [dx, dy];
    const snapped = (middle: number, d: number, origin: number) =>
      Math.round((middle + d - origin) / GRID) * GRID + origin - middle;
    return [snapped(main.middle[0], dx, atX), snapped(main.middle[1], dy, atY)];
  };
  let shapes: Shape[] = [];
  return {
    isScrolling: true,
    move: (event) => {
      if (shapes.length === 0) shapes = items.map((item) => canvas.shape(item));
      for (const shape of shapes) shape.move(by(event));
    },
    end: (event) => {
      for (const shape of shapes) shape.move(null);
      if (!event || !scene) return;
      const moved = shift(items, by(event));
      void editor.perform(async () => {
        await editor.change(scene.sheet, [place(scene.drawn, scene.sheet, moved)], reading);
        editor.focus(false);
      });
    },
  };
}

/** Draws a line from the lower handle of the step that has the focus to another step. */
export function connection(editor: ChartEditor): Drag {
  const { canvas } = editor;
  const step = editor.scene?.focus;
  const { reading } = editor.document;
  const path = s("path", { class: "connection" });
  return {
    isScrolling: true,
    move: (event) => {
      if (step?.kind !== "step") return;
      const [x, y, width, height] = step.element.frame;
      path.setAttribute("d", `M${x + width / 2} ${y + height}L${canvas.point(event).join(" ")}`);
      if (!path.isConnected) canvas.overlay.append(path);
    },
    end: (event) => {
      path.remove();
      if (!event || step?.kind !== "step") return;
      const goal = canvas.at(document.elementFromPoint(event.clientX, event.clientY))?.item;
      if (goal?.kind !== "step" || goal.sheet !== step.sheet) return;
      const edit = { connect: { from: [step.id], to: [goal.id] } };
      void editor.perform(async () => {
        await editor.change(step.sheet, [edit], reading);
        editor.focus(false);
      });
    },
  };
}

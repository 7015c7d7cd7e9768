// Where there is room for what is read beside a transition: the place of several at which the least
// of the drawing is in the way.
import { barFrame, LETTER, meet, TEXT_LINE, type Drawn, type Point } from "./drawn";
import type { TransitionItem } from "./drawn";
import type { Frame } from "./protocol";

/** So much room a note takes. */
const WIDTH = 190;
const HEIGHT = 26;
/** From the middle of its first line to its upper edge. */
const ABOVE = 6;

const found = new WeakMap<TransitionItem, Point>();

/** The beginning of a note, on the middle line of its first line. */
export function roomFor(drawn: Drawn, item: TransitionItem): Point {
  const known = found.get(item);
  if (known) return known;
  const { label, text } = item.element;
  const [x, y] = label;
  const beside = x + (Math.max(0, ...text.map(({ length }) => length)) + 1) * LETTER;
  const places: Point[] = [
    [x, y + text.length * TEXT_LINE],
    [x + 2 * LETTER, y + text.length * TEXT_LINE],
    [beside, y],
    [beside + 2 * LETTER, y],
    [x, y - HEIGHT],
  ];
  const obstacles = obstaclesTo(drawn, item);
  const inTheWay = ([left, top]: Point) => {
    const room: Frame = [left, top - ABOVE, WIDTH, HEIGHT];
    return obstacles.filter((frame) => meet(frame, room)).length;
  };
  const best = places.reduce((one, other) => (inTheWay(other) < inTheWay(one) ? other : one));
  found.set(item, best);
  return best;
}

function obstaclesTo(drawn: Drawn, of: TransitionItem): Frame[] {
  return drawn.ofSheet(of.sheet).flatMap((item): Frame[] => {
    if (item.kind === "step")
      return [item.element.frame, ...item.element.actions.map(({ frame }) => frame)];
    const { lines, doubles } = item.element;
    const own = item === of ? [] : [barFrame(item.element)];
    const double = doubles.map(([x, y, end]): Frame => [Math.min(x, end), y, Math.abs(end - x), 4]);
    return [...own, ...double, ...lines.flatMap(parts)];
  });
}

/** The straight parts of a line, as frames. */
function parts(points: readonly Point[]): Frame[] {
  return points.slice(1).map(([x, y], at): Frame => {
    const [fromX, fromY] = points[at] ?? [x, y];
    return [Math.min(x, fromX), Math.min(y, fromY), Math.abs(x - fromX), Math.abs(y - fromY)];
  });
}

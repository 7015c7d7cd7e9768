// Where there is room for what is read beside a transition: the place of several at which the least
// of the drawing is in the way.
import { meet } from "../page/ground";
import { barFrame, LETTER, TEXT_LINE } from "./drawn";
import type { Drawn, Point, TransitionItem } from "./drawn";
import type { Frame } from "./protocol";

/** So wide a note is, as a rule, and each of its lines high. */
const WIDTH = 150;
const LINE = 13;
/** From the middle of its first line to its upper edge. */
const ABOVE = 6;
/** How bad it is to be over a line, a box, or a text. */
const BAD = { line: 1, box: 3, text: 5 };

interface Obstacle {
  frame: Frame;
  bad: number;
}

const found = new WeakMap<TransitionItem, Point>();

/** The beginning of a note, on the middle line of its first line. */
export function roomFor(drawn: Drawn, item: TransitionItem): Point {
  const known = found.get(item);
  if (known) return known;
  const { label, text, operands } = item.element;
  const [x, y] = label;
  const high = operands.some(({ kind }) => kind !== "truth") ? 2 * LINE : LINE;
  const obstacles = obstaclesTo(drawn, item);
  const inTheWay = ([left, top]: Point) =>
    obstacles.filter(({ frame }) => meet(frame, [left, top - ABOVE, WIDTH, high]));
  const below = y + text.length * TEXT_LINE;
  const boxes = inTheWay([x, below]).filter(({ bad }) => bad === BAD.box);
  const beyond = Math.max(x, ...boxes.map(({ frame }) => frame[0] + frame[2] + LETTER));
  const beside = x + (Math.max(0, ...text.map(({ length }) => length)) + 1) * LETTER;
  const places: Point[] = [
    [x, below],
    [beside, y],
    [x, y - ABOVE - high],
    [beyond, below],
  ];
  const badness = (place: Point) => inTheWay(place).reduce((sum, { bad }) => sum + bad, 0);
  const best = places.reduce((one, other) => (badness(other) < badness(one) ? other : one));
  found.set(item, best);
  return best;
}

function obstaclesTo(drawn: Drawn, of: TransitionItem): Obstacle[] {
  const all = (bad: number, frames: Frame[]) => frames.map((frame) => ({ frame, bad }));
  return drawn.ofSheet(of.sheet).flatMap((item) => {
    if (item.kind === "step") {
      const { frame, actions } = item.element;
      return all(BAD.box, [frame, ...actions.map((action) => action.frame)]);
    }
    const { element } = item;
    const doubles = element.doubles.map(([x, y, end]): Frame => {
      return [Math.min(x, end), y, Math.abs(end - x), 4];
    });
    return [
      ...all(BAD.text, item === of ? [] : [barFrame(element)]),
      ...all(BAD.line, [...doubles, ...element.lines.flatMap(parts)]),
    ];
  });
}

/** The straight parts of a line, as frames. */
function parts(points: readonly Point[]): Frame[] {
  return points.slice(1).map(([x, y], at): Frame => {
    const [fromX, fromY] = points[at] ?? [x, y];
    return [Math.min(x, fromX), Math.min(y, fromY), Math.abs(x - fromX), Math.abs(y - fromY)];
  });
}

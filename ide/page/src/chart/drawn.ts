// What is drawn, to be found: by its id, its place, its line in the text. Where everything is, the
// module of charts says.
import type { Point } from "../page/ground";
import type { Charts, ChartSheet, ChartStep, ChartTransition, ElementId, Frame } from "./protocol";

export type { Point };

interface Common {
  /** Tells elements of all charts apart. */
  key: string;
  /** The number of its chart. */
  sheet: number;
  id: ElementId;
  /** Everything that is drawn of it is in it. */
  box: Frame;
  /** Where it is: a step's middle, or that of a transition's bar. */
  middle: Point;
}
/** `isFolded`: of a macro-step whether its chart is; null of other steps. */
export type StepItem = Common & { kind: "step"; element: ChartStep; isFolded: boolean | null };
export type TransitionItem = Common & { kind: "transition"; element: ChartTransition };
export type Item = StepItem | TransitionItem;

/** Around points, with room for the thickness of lines. */
function around(points: readonly Point[]): Frame {
  const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
  const [left, top] = [Math.min(...xs) - MARGIN, Math.min(...ys) - MARGIN];
  return [left, top, Math.max(...xs) + MARGIN - left, Math.max(...ys) + MARGIN - top];
}
const MARGIN = 12;
/** A character of a condition, and from line to line. */
export const LETTER = 8;
export const TEXT_LINE = 15;

const corners = ([x, y, width, height]: Frame): Point[] => [
  [x, y],
  [x + width, y + height],
];

/** A bar with its text. */
export function barFrame({ bar: [x, y, endX, endY], text, label }: ChartTransition): Frame {
  const wide = Math.max(0, ...text.map((words) => words.length * LETTER));
  const above = Math.min(y, label[1]) - 8;
  const below = Math.max(endY, label[1] + (text.length - 1) * TEXT_LINE) + 8;
  return [x - 2, above, Math.max(label[0] + wide, endX) - x + 4, below - above];
}

function stepItem(sheet: number, element: ChartStep, isFolded: boolean | null): StepItem {
  const [x, y, width, height] = element.frame;
  const box = around(
    [element.frame, ...element.actions.map(({ frame }) => frame)].flatMap(corners),
  );
  const middle = [x + width / 2, y + height / 2] as const;
  return {
    kind: "step",
    key: `${sheet}:${element.id}`,
    sheet,
    id: element.id,
    element,
    box,
    middle,
    isFolded,
  };
}

function transitionItem(sheet: number, element: ChartTransition): TransitionItem {
  const { bar, lines, id } = element;
  const box = around([...lines.flat(), ...corners(barFrame(element))]);
  const middle = [(bar[0] + bar[2]) / 2, (bar[1] + bar[3]) / 2] as const;
  return { kind: "transition", key: `${sheet}:${id}`, sheet, id, element, box, middle };
}

export class Drawn {
  readonly items: Item[];
  private byKey: Map<string, Item>;
  private byName: Map<string, Item> | undefined;

  constructor(readonly charts: Charts) {
    const isFolded = ({ expansion }: ChartStep) =>
      expansion === null ? null : (charts.sheets[expansion]?.isFolded ?? null);
    this.items = charts.sheets.flatMap((sheet, at) => [
      ...sheet.steps.map((step) => stepItem(at, step, isFolded(step))),
      ...sheet.transitions.map((one) => transitionItem(at, one)),
    ]);
    this.byKey = new Map(this.items.map((item) => [item.key, item]));
  }

  /** Whether there is nothing to be seen. */
  get isEmpty(): boolean {
    return this.items.length === 0;
  }

  get isEditable(): boolean {
    return this.charts.mistake === null && this.charts.obstacle === null;
  }

  sheet(at: number): ChartSheet | undefined {
    return this.charts.sheets[at];
  }

  at(sheet: number, id: ElementId): Item | undefined {
    return this.byKey.get(`${sheet}:${id}`);
  }

  byKeyOf(key: string): Item | undefined {
    return this.byKey.get(key);
  }

  ofSheet(sheet: number): Item[] {
    return this.items.filter((item) => item.sheet === sheet);
  }

  /** The element that a line of the text is in. */
  atLine(line: number): Item | undefined {
    let found: Item | undefined;
    for (const item of this.items) {
      const at = item.element.line;
      if (at <= line && (!found || at > found.element.line)) found = item;
    }
    return found;
  }

  /** What has the name of an element of another drawing: ids are new ones when a text was changed
   * by hand. */
  like(item: Item, from: Drawn): Item | undefined {
    this.byName ??= new Map(this.items.map((one) => [this.nameOf(one), one]));
    return this.byName.get(from.nameOf(item));
  }

  private nameOf(item: Item): string {
    const { sheet } = item;
    if (item.kind === "step") return `${sheet} ${item.element.fullName}`;
    const { from, to, condition } = item.element;
    const names = (ids: ElementId[]) => ids.map((id) => this.at(sheet, id)?.element).map(stepName);
    return `${sheet} ${names(from).join()}>${names(to).join()}:${condition}`;
  }

  /** The element nearest to a point of a chart. */
  nearest(sheet: number, [x, y]: Point): Item | undefined {
    const far = ({ middle }: Item) => Math.hypot(middle[0] - x, middle[1] - y);
    let found: Item | undefined;
    for (const item of this.items)
      if (item.sheet === sheet && (!found || far(item) < far(found))) found = item;
    return found;
  }
}

function stepName(element: ChartStep | ChartTransition | undefined): string {
  return element && "fullName" in element ? element.fullName : "";
}

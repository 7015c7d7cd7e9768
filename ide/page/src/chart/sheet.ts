// A chart as a picture: its steps with their actions, its transitions, and which of them are
// active or enabled. Where everything is, the core says.
import type { ChartSheet, ChartStep, ChartTransition } from "../core/protocol";
import { s } from "../page/dom";
import { t } from "../text/language";

/** Between the lines of a text, those of a double line, and the frames of an initial step. */
const TEXT_LINE = 15;
const DOUBLE = 4;
const INSET = 4;

/** A step or a transition that is drawn. */
export class Shape {
  /** All of it. */
  readonly group: SVGGElement;
  /** What has the focus and the name, which says all that is written around it. */
  readonly button: SVGGElement;
  private state: boolean | null = null;

  constructor(
    readonly element: ChartStep | ChartTransition,
    frame: readonly number[],
    private name: (state: boolean | null) => string,
    ...parts: SVGElement[]
  ) {
    this.button = s("g", { role: "button", tabindex: -1 }, rect(frame, "frame"));
    const picture = s("g", { "aria-hidden": "true" }, ...parts);
    this.group = s("g", { class: "element" }, picture, this.button);
    this.show(null);
  }

  /** Whether it is active, or enabled; null where that is not known. */
  show(state: boolean | null): void {
    this.group.classList.toggle("on", state === true);
    const name = this.name(state);
    if (this.button.getAttribute("aria-label") !== name || this.state !== state)
      this.button.setAttribute("aria-label", name);
    this.state = state;
  }
}

type Point = readonly [number, number];

const rect = ([x, y, width, height]: readonly number[], kind = "") =>
  s("rect", { x, y, width, height, class: kind });

const line = (points: readonly Point[], kind = "wire") =>
  s("path", { d: `M${points.map((point) => point.join(" ")).join("L")}`, class: kind });

const text = ([x, y]: Point, words: string, kind = "") => s("text", { x, y, class: kind }, words);

function stepParts(step: ChartStep): SVGElement[] {
  const [x, y, width, height] = step.frame;
  const [right, bottom] = [x + width, y + height];
  const middle = y + height / 2;
  const parts: SVGElement[] = [rect(step.frame, "body")];
  if (step.isInitial)
    parts.push(rect([x + INSET, y + INSET, width - 2 * INSET, height - 2 * INSET], "body"));
  if (step.look === "macro")
    for (const at of [y + INSET, bottom - INSET])
      parts.push(
        line([
          [x, at],
          [right, at],
        ]),
      );
  if (step.look === "enclosing")
    for (const [edge, dx] of [
      [x, 8],
      [right, -8],
    ] as const)
      for (const [end, dy] of [
        [y, 8],
        [bottom, -8],
      ] as const)
        parts.push(
          line([
            [edge + dx, end],
            [edge, end + dy],
          ]),
        );
  const shift = step.note ? 6 : 0;
  parts.push(text([x + width / 2, middle - shift], step.name, "name"));
  if (step.note) parts.push(text([x + width / 2, middle + shift], step.note, "note"));
  if (step.isLinked) parts.push(text([x - 2 * INSET, middle], "*", "name"));
  const [first] = step.actions;
  if (first)
    parts.push(
      line([
        [right, middle],
        [first.frame[0], middle],
      ]),
    );
  for (const action of step.actions) {
    const [left, top, , high] = action.frame;
    const start = action.divider ?? left;
    parts.push(rect(action.frame, "action"));
    if (action.divider !== null)
      parts.push(
        line([
          [start, top],
          [start, top + high],
        ]),
        text([left + 6, top + high / 2], action.qualifier),
      );
    parts.push(text([start + 6, top + high / 2], action.name));
  }
  return parts;
}

function transitionParts(one: ChartTransition): SVGElement[] {
  const parts: SVGElement[] = one.lines.map((points) => line(points));
  for (const [x, y, end] of one.doubles)
    for (const by of [0, DOUBLE])
      parts.push(
        line([
          [x - INSET, y + by],
          [end + INSET, y + by],
        ]),
      );
  for (const [x, y] of one.arrows)
    parts.push(s("path", { d: `M${x} ${y}l-5 10h10z`, class: "arrow" }));
  const [x, y, right, bottom] = one.bar;
  parts.push(
    line(
      [
        [x, y],
        [right, bottom],
      ],
      "bar",
    ),
  );
  for (const [row, words] of one.text.entries())
    parts.push(text([one.label[0], one.label[1] + row * TEXT_LINE], words, "condition"));
  return parts;
}

/** A step with its actions. */
function stepFrame({ frame: [x, y, width, height], actions }: ChartStep): number[] {
  const [first] = actions;
  if (!first) return [x, y, width, height];
  const [left, top, wide, high] = first.frame;
  const above = Math.min(y, top);
  return [x, above, left + wide - x, Math.max(y + height, top + actions.length * high) - above];
}

/** A bar with its text, whose characters are 8 wide. */
function transitionFrame({ bar: [x, y], text, label }: ChartTransition): number[] {
  const wide = Math.max(0, ...text.map((words) => words.length * 8));
  const above = Math.min(y, label[1]) - 8;
  const below = Math.max(y, label[1] + (text.length - 1) * TEXT_LINE) + 8;
  return [x - 2, above, label[0] + wide - x + 4, below - above];
}

function stepName(step: ChartStep, state: boolean | null): string {
  const words = t(step.isInitial ? "chartInitial" : "chartStep", step.name);
  const actions = step.actions.map(({ qualifier, name }) => `${qualifier} ${name}`.trim());
  const known = state === null ? "" : t(state ? "chartActive" : "chartInactive");
  return [words, known, ...actions].filter(Boolean).join(", ");
}

function transitionName(one: ChartTransition, state: boolean | null): string {
  const words = t("chartTransition", `${one.title}: ${one.text.join(" ")}`);
  return state ? `${words}, ${t("chartEnabled")}` : words;
}

/** A chart that is drawn. */
export class Sheet {
  readonly group: SVGGElement;
  readonly steps: Shape[];
  readonly transitions: Shape[];

  constructor(private sheet: ChartSheet) {
    this.steps = sheet.steps.map(
      (step) =>
        new Shape(step, stepFrame(step), (state) => stepName(step, state), ...stepParts(step)),
    );
    this.transitions = sheet.transitions.map(
      (one) =>
        new Shape(
          one,
          transitionFrame(one),
          (state) => transitionName(one, state),
          ...transitionParts(one),
        ),
    );
    this.group = s(
      "g",
      { role: "group", "aria-label": t("chartOf", sheet.name) },
      text(sheet.title, sheet.name, "title"),
      ...this.transitions.map(({ group }) => group),
      ...this.steps.map(({ group }) => group),
    );
  }

  /** Which steps are active; a transition is enabled if all steps before it are. */
  show(active: readonly (boolean | null)[]): void {
    for (const [index, shape] of this.steps.entries()) shape.show(active[index] ?? null);
    for (const [index, shape] of this.transitions.entries()) {
      const from = this.sheet.transitions[index]?.from ?? [];
      const isKnown = from.every((step) => (active[step] ?? null) !== null);
      shape.show(isKnown && from.length > 0 ? from.every((step) => active[step]) : null);
    }
  }
}

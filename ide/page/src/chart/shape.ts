// A step or a transition as nodes of a picture: what is drawn, what has the focus and the name, and
// whether it is active or enabled.
import { s, setAttributes } from "../page/dom";
import { language, t } from "../text/language";
import { barFrame, TEXT_LINE, type Item, type Point } from "./drawn";
import type { Note } from "./note";
import type { ChartAction, ChartStep, ChartTransition } from "./protocol";

/** Between the lines of a double line, and between the frames of an initial step. */
const DOUBLE = 4;
const INSET = 4;
/** From line to line of what is read beside an element. */
const NOTE_LINE = 13;

export class Shape {
  /** All of it. */
  readonly group: SVGGElement;
  /** What has the focus and the name, which says all that is written around it. */
  readonly button: SVGGElement;
  /** What is drawn of it. */
  readonly picture = s("g", { "aria-hidden": "true" });
  private actions = s("g");
  /** What is read beside it while the program runs; it is over all elements. */
  readonly noted = s("text", { class: "note-live", "aria-hidden": "true" });
  private note: Note | null = null;
  private isCrossed = false;
  private drawn = "";
  private language = "";
  private state: boolean | null = null;
  /** Whether it is seen elsewhere than in its place. */
  isMoved = false;

  constructor(private item: Item) {
    this.button = button();
    this.group = s(
      "g",
      { class: "element", "data-key": item.key },
      this.picture,
      this.button,
      this.actions,
    );
    this.noted.setAttribute("data-key", item.key);
    this.update(item);
  }

  /** Draws what has changed. */
  update(item: Item): void {
    if (item === this.item && this.drawn !== "" && language() === this.language) return;
    this.item = item;
    this.language = language();
    const isFolded = item.kind === "step" ? item.isFolded : null;
    const drawn = JSON.stringify([item.element, isFolded, this.language]);
    if (drawn === this.drawn) return;
    this.drawn = drawn;
    const { kind, element } = item;
    if (kind === "step") {
      this.picture.replaceChildren(...stepParts(element), ...foldParts(element, isFolded));
      this.button.replaceChildren(rect(element.frame, "frame"));
      this.drawActions(element);
    } else {
      this.picture.replaceChildren(...transitionParts(element));
      const ways = element.lines.map((points) => line(points, "way"));
      this.button.replaceChildren(...ways, rect(barFrame(element), "frame"));
    }
    this.name();
  }

  /** What is read beside it, and whether it was crossed last. */
  tell(note: Note | null, isCrossed: boolean): void {
    if (note && note.at.join() !== this.note?.at.join())
      this.noted.setAttribute("transform", `translate(${note.at.join(" ")})`);
    if (note?.all !== this.note?.all) {
      this.noted.replaceChildren(...(note ? noteParts(note) : []));
      this.noted.classList.toggle("good", note?.isGood === true);
    }
    const isSame = note?.said === this.note?.said && isCrossed === this.isCrossed;
    this.note = note;
    this.isCrossed = isCrossed;
    if (isSame) return;
    this.group.classList.toggle("crossed", isCrossed);
    this.group.classList.toggle("true", note?.isGood === true && this.item.kind === "transition");
    this.name();
  }

  /** Buttons stay where they are, and with them the focus. */
  private drawActions(step: ChartStep): void {
    const { children } = this.actions;
    while (children.length > step.actions.length) children[children.length - 1]?.remove();
    for (const [at, action] of step.actions.entries()) {
      const node = children[at] ?? this.actions.appendChild(button({ "data-action": at }));
      node.replaceChildren(rect(action.frame, "frame"));
      node.setAttribute("aria-label", t("chartAction", actionName(action), step.fullName));
    }
  }

  /** Whether it is active, or enabled; null where that is not known. */
  show(state: boolean | null): void {
    if (state === this.state) return;
    this.state = state;
    this.group.classList.toggle("on", state === true);
    this.name();
  }

  /** Whether it is selected. */
  select(isSelected: boolean): void {
    this.group.classList.toggle("selected", isSelected);
    this.button.setAttribute("aria-pressed", String(isSelected));
  }

  /** Shows it elsewhere while it is dragged, or, for null, in its place. */
  move(by: Point | null): void {
    this.isMoved = by !== null;
    this.group.classList.toggle("moving", this.isMoved);
    this.noted.toggleAttribute("hidden", this.isMoved);
    if (by) this.group.setAttribute("transform", `translate(${by.join(" ")})`);
    else this.group.removeAttribute("transform");
  }

  remove(): void {
    this.group.remove();
    this.noted.remove();
  }

  /** Its button, or that of an action. */
  target(action: number | null): SVGGElement {
    const target = action === null ? undefined : this.actions.children[action];
    return target instanceof SVGGElement ? target : this.button;
  }

  private name(): void {
    const { item, state } = this;
    const name =
      item.kind === "step" ? stepName(item.element, state) : transitionName(item.element, state);
    const folded = item.kind === "step" && item.isFolded ? t("chartFolded") : "";
    const crossed = this.isCrossed ? t("chartCrossed") : "";
    const words = [name, folded, this.note?.said, crossed].filter(Boolean);
    this.button.setAttribute("aria-label", words.join(", "));
  }
}

function button(attributes: Record<string, number> = {}): SVGGElement {
  const node = s("g", { role: "button", tabindex: -1 });
  setAttributes(node, attributes);
  return node;
}

const rect = ([x, y, width, height]: readonly number[], kind = "") =>
  s("rect", { x, y, width, height, class: kind });

const line = (points: readonly Point[], kind = "wire") =>
  s("path", { d: `M${points.map((point) => point.join(" ")).join("L")}`, class: kind });

const text = ([x, y]: Point, words: string, kind = "") => s("text", { x, y, class: kind }, words);

/** The name of a chart over it. */
export const title = (at: Point, words: string) => text(at, words, "title");

function stepParts(step: ChartStep): SVGElement[] {
  const [x, y, width, height] = step.frame;
  const middle = y + height / 2;
  const parts: SVGElement[] = [rect(step.frame, "body")];
  if (step.isInitial)
    parts.push(rect([x + INSET, y + INSET, width - 2 * INSET, height - 2 * INSET], "body"));
  parts.push(...lookParts(step));
  const shift = step.note ? 6 : 0;
  parts.push(text([x + width / 2, middle - shift], step.name, "name"));
  if (step.note) parts.push(text([x + width / 2, middle + shift], step.note, "note"));
  if (step.isLinked) parts.push(text([x - 2 * INSET, middle], "*", "name"));
  const [first] = step.actions;
  if (first) parts.push(s("g", { class: "block" }, ...blockParts(step, first)));
  if (step.comment) parts.push(s("title", {}, step.comment));
  return parts;
}

/** What a macro-step and an enclosing step have more than others. */
function lookParts({ look, frame: [x, y, width, height] }: ChartStep): SVGElement[] {
  const [right, bottom] = [x + width, y + height];
  const parts: Point[][] = [];
  if (look === "macro")
    for (const at of [y + INSET, bottom - INSET])
      parts.push([
        [x, at],
        [right, at],
      ]);
  if (look === "enclosing")
    for (const [edge, dx] of [
      [x, 8],
      [right, -8],
    ] as const)
      for (const [end, dy] of [
        [y, 8],
        [bottom, -8],
      ] as const)
        parts.push([
          [edge + dx, end],
          [edge, end + dy],
        ]);
  return parts.map((points) => line(points));
}

function noteParts({ lines, all }: Note): SVGElement[] {
  const parts = lines.map((words, at) => s("tspan", { x: 0, y: at * NOTE_LINE }, words));
  return all === lines.join() ? parts : [...parts, s("title", {}, all)];
}

/** Whether the chart of a macro-step is shown. */
function foldParts({ frame: [x, y, width] }: ChartStep, isFolded: boolean | null) {
  if (isFolded === null) return [];
  return [text([x + width - 8, y + 10], isFolded ? "▸" : "▾", "note")];
}

function blockParts({ frame, actions }: ChartStep, first: ChartAction): SVGElement[] {
  const middle = frame[1] + frame[3] / 2;
  const parts: SVGElement[] = [
    line([
      [frame[0] + frame[2], middle],
      [first.frame[0], middle],
    ]),
  ];
  for (const action of actions) {
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

function actionName({ qualifier, name }: ChartAction): string {
  return `${qualifier} ${name}`.trim();
}

function stepName(step: ChartStep, state: boolean | null): string {
  const words = t(step.isInitial ? "chartInitial" : "chartStep", step.fullName);
  const known = state === null ? "" : t(state ? "chartActive" : "chartInactive");
  return [words, known, ...step.actions.map(actionName)].filter(Boolean).join(", ");
}

function transitionName(one: ChartTransition, state: boolean | null): string {
  const words = t("chartTransition", `${one.title}: ${one.text.join(" ")}`);
  return state ? `${words}, ${t("chartEnabled")}` : words;
}

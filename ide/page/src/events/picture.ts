// The execution control chart of a block as a picture: the state that it is in, and the way that
// the last event has taken.
import { s } from "../page/dom";
import { Ground, type Frame, type Point } from "../page/ground";
import { t } from "../text/language";
import type { Boxed, Events, EventState, EventTransition } from "./protocol";

/** Between the frames of the initial state. */
const INSET = 4;
const ROUND = 10;

export class Picture extends Ground {
  private layer = s("g");

  constructor() {
    super();
    this.svg.append(this.layer);
  }

  draw(events: Events): void {
    const { width, height, name, title, states, transitions } = events;
    this.svg.setAttribute("aria-label", t("eventsChartOf", name, states[events.state]?.name ?? ""));
    this.layer.replaceChildren(
      text(title, name, "title"),
      ...transitions.map((one, at) => transition(one, events.cleared.includes(at))),
      ...states.map((one, at) => state(one, at === events.state)),
    );
    this.spread([0, 0, width, height]);
  }

  refresh(): void {
    // All of a chart has nodes: it is small.
  }

  /** Scrolls to a state. */
  show(state: EventState | undefined): void {
    if (state) this.reveal(state.frame);
  }
}

function state(one: EventState, isActive: boolean): SVGElement {
  const { frame, name, comment, isInitial, actions } = one;
  const [x, y, width, height] = frame;
  const inner: Frame = [x + INSET, y + INSET, width - 2 * INSET, height - 2 * INSET];
  const boxes = actions.flatMap(({ algorithm, output }) => [
    ...(algorithm ? [rect(algorithm.frame, "action"), boxText(algorithm, "note")] : []),
    ...(output ? [rect(output.frame, "action"), boxText(output, "note output")] : []),
  ]);
  const first = actions[0]?.algorithm ?? actions[0]?.output;
  const middle = y + height / 2;
  const lead = first ? `M${x + width} ${middle}L${first.frame[0]} ${middle}` : null;
  return s(
    "g",
    { class: isActive ? "state on" : "state" },
    ...(comment === "" ? [] : [s("title", {}, comment)]),
    ...(lead ? [s("path", { class: "wire", d: lead })] : []),
    ...boxes,
    rect(frame, "body", ROUND),
    ...(isInitial ? [rect(inner, "body", ROUND - INSET)] : []),
    text([x + width / 2, middle], name, "name"),
  );
}

function transition(one: EventTransition, isTaken: boolean): SVGElement {
  const [from, near, far, to] = one.curve.map((point) => point.join(" "));
  const [x, y] = one.middle;
  const [left, top, , height] = one.label;
  return s(
    "g",
    { class: isTaken ? "link taken" : "link" },
    s("path", { class: "wire", d: `M${from}C${near} ${far} ${to}` }),
    s("path", { class: "arrow", d: `M${one.arrow.map((point) => point.join(" ")).join("L")}z` }),
    s("circle", { class: "arrow", cx: x, cy: y, r: 3 }),
    text([left, top + height / 2], one.text, "condition"),
  );
}

function boxText({ text: words, frame }: Boxed, name: string): SVGTextElement {
  const [x, y, width, height] = frame;
  return text([x + width / 2, y + height / 2], words, name);
}

function rect([x, y, width, height]: Frame, name: string, rx = 0): SVGRectElement {
  return s("rect", { x, y, width, height, rx, class: name });
}

function text([x, y]: Point, words: string, name: string): SVGTextElement {
  return s("text", { x, y, class: name }, words);
}

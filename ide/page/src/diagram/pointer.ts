// A pointer in a diagram: it moves elements, draws links from pin to pin, and moves the ground.
import { s } from "../page/dom";
import type { Point } from "../page/ground";
import { nameOf, snapped, type Edits } from "./edits";
import type { Selection } from "./selection";
import type { Item, Sheets } from "./sheets";

/** A drag is farther than this, in pixels. */
const FAR = 4;

/** An end of a link: the number of a pin of an element. */
interface Port {
  item: Item;
  isInput: boolean;
  pin: number;
}

export class Pointer {
  constructor(
    private sheets: Sheets,
    private edits: Edits,
    private selection: Selection,
  ) {
    sheets.element.addEventListener("pointerdown", (event) => this.down(event));
  }

  private down(event: PointerEvent): void {
    if (event.button > 1) return;
    const port = this.portOf(event.target);
    const item = this.sheets.at(event.target);
    const group = this.sheets.groupAt(event.target);
    if (port) this.link(event, port);
    else if (item && event.button === 0) this.carry(event, this.withOthers(item));
    else if (group.length > 0 && event.button === 0)
      this.carry(event, group, this.sheets.groupNode(event.target));
    else if (event.pointerType !== "touch") this.pan(event);
  }

  private portOf(node: EventTarget | null): Port | undefined {
    const item = this.sheets.at(node);
    const port = node instanceof Element ? node.closest("[data-pin]") : null;
    if (!item || !port) return undefined;
    const pin = Number(port.getAttribute("data-pin"));
    return { item, isInput: port.getAttribute("data-side") === "input", pin };
  }

  /** A link from a pin: its other end is where the pointer leaves it. */
  private link(down: PointerEvent, from: Port): void {
    const line = s("path", { class: "connection" });
    const [x, y] = this.sheets.point(down);
    track(down, {
      move: (event) => {
        const [toX, toY] = this.sheets.point(event);
        line.setAttribute("d", `M${x} ${y}L${toX} ${toY}`);
        if (!line.isConnected) this.sheets.overlay.append(line);
      },
      end: (event, isDrag) => {
        line.remove();
        if (isDrag) this.connect(from, event);
      },
    });
  }

  private connect(from: Port, event: PointerEvent): void {
    const node = document.elementFromPoint(event.clientX, event.clientY);
    const to = this.portOf(node) ?? this.nearest(node, event, !from.isInput);
    if (to && to.isInput !== from.isInput) {
      const [input, output] = from.isInput ? [from, to] : [to, from];
      if (input.item.sheet === output.item.sheet)
        void this.edits.give(input.item, nameOfInput(input), nameOf(output.item, output.pin));
    } else if (from.isInput && !to && from.item.linked.includes(from.pin)) {
      void this.edits.give(from.item, nameOfInput(from), "");
    }
  }

  /** The pin of an element that is nearest. */
  private nearest(node: Element | null, event: PointerEvent, isInput: boolean): Port | undefined {
    const item = this.sheets.at(node);
    if (!item) return undefined;
    const pins = isInput ? item.element.inputs : item.element.outputs;
    const [, y] = this.sheets.point(event);
    const far = pins.map(({ at }) => Math.abs(at[1] - y));
    const pin = far.indexOf(Math.min(...far));
    return pin < 0 ? undefined : { item, isInput, pin };
  }

  /** What is chosen moves together. */
  private withOthers(item: Item): Item[] {
    return this.selection.has(item) ? this.selection.chosen : [item];
  }

  /** `frame`: what is moved with them. */
  private carry(down: PointerEvent, items: Item[], frame?: Element | null): void {
    const shapes = items.flatMap((one) => this.sheets.shape(one)?.group ?? []);
    const groups = frame ? [frame, ...shapes] : shapes;
    const start = this.sheets.point(down);
    const by = (event: PointerEvent): Point => {
      const [x, y] = this.sheets.point(event);
      return snapped([x - start[0], y - start[1]]);
    };
    track(down, {
      move: (event) => {
        const to = `translate(${by(event).join(" ")})`;
        for (const group of groups) group.setAttribute("transform", to);
      },
      end: (event, isDrag) => {
        for (const group of groups) group.removeAttribute("transform");
        const far = by(event);
        if (isDrag && far.some((one) => one !== 0)) void this.edits.move(items, far);
      },
    });
  }

  /** A mouse moves the ground; a finger does it by itself. */
  private pan(down: PointerEvent): void {
    const { element } = this.sheets;
    const [left, top] = [element.scrollLeft, element.scrollTop];
    track(down, {
      move: ({ clientX, clientY }) =>
        element.scrollTo(left - clientX + down.clientX, top - clientY + down.clientY),
      end: () => undefined,
    });
  }
}

function nameOfInput({ item, pin }: Port): string {
  return item.element.inputs[pin]?.name ?? "";
}

interface Drag {
  /** The pointer is far enough from where it began. */
  move: (event: PointerEvent) => void;
  end: (event: PointerEvent, isDrag: boolean) => void;
}

/** Follows a pointer until it is up; what is cancelled was no drag. */
function track(down: PointerEvent, { move, end }: Drag): void {
  let isDrag = false;
  const controller = new AbortController();
  const { signal } = controller;
  const moved = (event: PointerEvent) => {
    if (event.pointerId !== down.pointerId) return;
    isDrag ||= Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) > FAR;
    if (isDrag) move(event);
  };
  const ended = (event: PointerEvent, isGood: boolean) => {
    if (event.pointerId !== down.pointerId) return;
    controller.abort();
    end(event, isDrag && isGood);
  };
  addEventListener("pointermove", moved, { signal });
  addEventListener("pointerup", (event) => ended(event, true), { signal });
  addEventListener("pointercancel", (event) => ended(event, false), { signal });
}

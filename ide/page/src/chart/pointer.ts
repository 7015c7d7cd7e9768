// A pointer in the drawing: a click selects, a drag moves steps, the ground or a band, two fingers
// change the size.
import { Autoscroll } from "./autoscroll";
import { connection, band, move, pan, type Drag } from "./drags";
import type { ChartEditor } from "./editor";

/** So far a pointer goes before it is a drag, in pixels. */
const FAR = { mouse: 4, touch: 10 };
/** A second click comes within this time. */
const DOUBLE_MS = 400;

interface Pressed {
  event: PointerEvent;
  /** What it becomes as soon as it is far enough. */
  drag: Drag;
  isDrag: boolean;
}

export class Pointer {
  private pressed: Pressed | undefined;
  private fingers = new Map<number, PointerEvent>();
  private last = { key: "", at: 0 };
  private autoscroll: Autoscroll;

  constructor(private editor: ChartEditor) {
    const { element } = editor.canvas;
    this.autoscroll = new Autoscroll(element, (event) => this.pressed?.drag.move(event));
    element.addEventListener("pointerdown", (event) => this.down(event));
    element.addEventListener("pointermove", (event) => this.moved(event));
    element.addEventListener("pointerup", (event) => this.up(event));
    element.addEventListener("pointercancel", (event) => this.cancel(event));
    // The focus goes where this has it go, and nothing of the page is selected.
    element.addEventListener("mousedown", (event) => {
      if (!isField(event)) event.preventDefault();
    });
    // In the drawing or in a field of it: clicks before and after a key are two, however soon.
    element.addEventListener("keydown", () => (this.last.key = ""), { capture: true });
    element.addEventListener("keydown", (event) => {
      if (event.key === "Escape" && this.pressed) this.cancel(this.pressed.event);
    });
  }

  private down(event: PointerEvent): void {
    if (isField(event) || event.button > 1) return;
    const { element } = this.editor.canvas;
    if (event.pointerType === "touch") {
      this.fingers.set(event.pointerId, event);
      if (this.fingers.size > 1) return this.finish(null);
    }
    element.setPointerCapture(event.pointerId);
    this.pressed = { event, drag: this.dragOf(event), isDrag: false };
  }

  /** What a drag from here does. */
  private dragOf(event: PointerEvent): Drag {
    const { editor } = this;
    const isTouch = event.pointerType === "touch";
    if (event.button === 1 || editor.isPanning) return pan(editor, event);
    const spot = editor.canvas.at(event.target);
    if (!spot) {
      if (isHandle(event)) return connection(editor);
      return isTouch ? pan(editor, event) : band(editor, event);
    }
    const isSelected = editor.isSelected(spot.item);
    if (isTouch && !isSelected) return pan(editor, event);
    if (!isSelected && !event.shiftKey) editor.selection.only(spot.item, spot.action);
    return editor.scene?.drawn.isEditable ? move(editor, event) : pan(editor, event);
  }

  private moved(event: PointerEvent): void {
    const before = this.fingers.get(event.pointerId);
    if (before) this.fingers.set(event.pointerId, event);
    if (before && this.fingers.size === 2) return this.pinch(before, event);
    const { pressed } = this;
    if (!pressed || pressed.event.pointerId !== event.pointerId) return;
    const far = Math.hypot(
      event.clientX - pressed.event.clientX,
      event.clientY - pressed.event.clientY,
    );
    pressed.isDrag ||= far > (event.pointerType === "touch" ? FAR.touch : FAR.mouse);
    if (!pressed.isDrag) return;
    pressed.drag.move(event);
    if (pressed.drag.isScrolling) this.autoscroll.follow(event);
  }

  /** Two fingers: the ground follows their middle, its size their distance. */
  private pinch(before: PointerEvent, now: PointerEvent): void {
    const other = [...this.fingers.values()].find(({ pointerId }) => pointerId !== now.pointerId);
    if (!other) return;
    const { canvas } = this.editor;
    const far = (one: PointerEvent) =>
      Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY);
    canvas.element.scrollLeft -= (now.clientX - before.clientX) / 2;
    canvas.element.scrollTop -= (now.clientY - before.clientY) / 2;
    const middle = {
      clientX: (now.clientX + other.clientX) / 2,
      clientY: (now.clientY + other.clientY) / 2,
    };
    canvas.zoomTo((canvas.zoom * far(now)) / Math.max(1, far(before)), middle);
  }

  private up(event: PointerEvent): void {
    this.fingers.delete(event.pointerId);
    const { pressed } = this;
    if (!pressed || pressed.event.pointerId !== event.pointerId) return;
    this.finish(pressed.isDrag ? event : null);
    if (!pressed.isDrag) this.clicked(pressed.event);
  }

  private clicked(event: PointerEvent): void {
    const { editor } = this;
    if (event.button !== 0) return;
    const spot = editor.canvas.at(event.target);
    if (!spot) {
      if (!isHandle(event)) editor.selection.clear();
      return editor.canvas.element.focus({ preventScroll: true });
    }
    const key = `${spot.item.key} ${spot.action}`;
    const isDouble = key === this.last.key && event.timeStamp - this.last.at < DOUBLE_MS;
    this.last = { key: isDouble ? "" : key, at: event.timeStamp };
    if (event.shiftKey) editor.selection.toggle(spot.item);
    else editor.selection.only(spot.item, spot.action);
    editor.focus(false);
    if (isDouble && (event.ctrlKey || event.metaKey)) editor.goToText();
    else if (isDouble) void editor.commands.run("write");
  }

  private cancel(event: PointerEvent): void {
    this.fingers.delete(event.pointerId);
    this.finish(null);
  }

  /** Ends the drag: here, or, for null, without an effect. */
  private finish(event: PointerEvent | null): void {
    const { pressed } = this;
    this.pressed = undefined;
    this.autoscroll.stop();
    pressed?.drag.end(event);
  }

  /** With Ctrl it changes the size; so does a pinch on a touchpad. */
}

const isIn = (event: Event, what: string) =>
  event.target instanceof Element && event.target.closest(what) !== null;
const isField = (event: Event) => isIn(event, ".field");
const isHandle = (event: Event) => isIn(event, ".handle");

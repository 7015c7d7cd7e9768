// The ground of a drawing: which part of it is seen and how large, and scrolling to what is
// wanted. What is drawn on it, what extends this knows.
import { h, s } from "./dom";

export type Point = readonly [x: number, y: number];
export type Frame = readonly [x: number, y: number, width: number, height: number];

const ZOOM = { min: 0.1, max: 3, step: 1.25 };
/** What is as large as fits is not larger, and to be read not smaller. */
const ZOOM_FIT = { min: 0.7, max: 1.5 };
/** Free ground around a drawing, and what is left between an element and the edge, in its units. */
const GROUND = 40;
const EDGE = 24;

export abstract class Ground {
  readonly svg = s("svg", { role: "group" });
  /** Holds the drawing, and what is put over it. */
  readonly ground = h("div", { class: "ground" }, this.svg);
  /** What scrolls. */
  readonly element = h("div", { class: "sheets" }, this.ground);
  zoom = 1;
  /** The part that is shown. */
  bounds: Frame = [0, 0, 0, 0];
  private frame = 0;

  constructor() {
    this.element.addEventListener("scroll", () => this.later());
    this.element.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    new ResizeObserver(() => this.later()).observe(this.element);
  }

  /** Shows what can be seen now. */
  abstract refresh(): void;

  /** Another drawing is on it: it takes this. */
  protected spread([x, y, width, height]: Frame): void {
    this.bounds = [x - GROUND, y - GROUND, width + 2 * GROUND, height + 2 * GROUND];
    this.scale(this.zoom);
    this.refresh();
  }

  /** Shows before the next frame what has changed. */
  later(): void {
    cancelAnimationFrame(this.frame);
    this.frame = requestAnimationFrame(() => this.refresh());
  }

  /** What can be seen, in units of the drawing. */
  view(ahead = 0): Frame {
    const { scrollLeft, scrollTop, clientWidth, clientHeight } = this.element;
    const [x, y] = this.bounds;
    const by = ahead / this.zoom;
    return [
      x + scrollLeft / this.zoom - by,
      y + scrollTop / this.zoom - by,
      clientWidth / this.zoom + 2 * by,
      clientHeight / this.zoom + 2 * by,
    ];
  }

  /** A point of the window in the drawing. */
  point({ clientX, clientY }: { clientX: number; clientY: number }): Point {
    const { left, top } = this.svg.getBoundingClientRect();
    const [x, y] = this.bounds;
    return [x + (clientX - left) / this.zoom, y + (clientY - top) / this.zoom];
  }

  private scale(zoom: number): void {
    this.zoom = Math.min(ZOOM.max, Math.max(ZOOM.min, zoom));
    const [x, y, width, height] = this.bounds;
    this.svg.setAttribute("viewBox", `${x} ${y} ${width} ${height}`);
    this.svg.style.width = `${width * this.zoom}px`;
    this.svg.style.height = `${height * this.zoom}px`;
  }

  /** Another size; a point of the window stays where it is, without one the middle. */
  zoomTo(zoom: number, at?: { clientX: number; clientY: number }): void {
    const { left, top, width, height } = this.element.getBoundingClientRect();
    const fixed = at ?? { clientX: left + width / 2, clientY: top + height / 2 };
    const before = this.point(fixed);
    this.scale(zoom);
    const after = this.point(fixed);
    this.element.scrollLeft += (before[0] - after[0]) * this.zoom;
    this.element.scrollTop += (before[1] - after[1]) * this.zoom;
    this.refresh();
  }

  /** A wheel with Ctrl, which is also what two fingers on a touchpad are, changes the size. */
  private wheel(event: WheelEvent): void {
    if (!event.ctrlKey) return;
    event.preventDefault();
    this.zoomTo(this.zoom * Math.exp(-event.deltaY / 300), event);
  }

  /** Larger, or smaller, by one step. */
  zoomBy(step: 1 | -1): void {
    this.zoomTo(this.zoom * ZOOM.step ** step);
  }

  /** Scrolls so that a point is in the middle. */
  centre([x, y]: Point): void {
    const { clientWidth, clientHeight } = this.element;
    this.element.scrollLeft = (x - this.bounds[0]) * this.zoom - clientWidth / 2;
    this.element.scrollTop = (y - this.bounds[1]) * this.zoom - clientHeight / 2;
  }

  /** As large as fits. */
  fit(): void {
    this.scale(Math.min(this.fitting(), ZOOM_FIT.max));
    this.refresh();
  }

  /** The beginning of another drawing: as much of it as can be read. */
  begin(): void {
    this.scale(Math.min(1, Math.max(ZOOM_FIT.min, this.fitting())));
    this.element.scrollTo(0, 0);
  }

  private fitting(): number {
    const [, , width, height] = this.bounds;
    const { clientWidth, clientHeight } = this.element;
    return Math.min(clientWidth / width, clientHeight / height);
  }

  /** Scrolls so far that a frame can be seen. */
  reveal([x, y, width, height]: Frame): void {
    const [left, top, wide, high] = this.view();
    const by = (at: number, size: number, from: number, room: number) => {
      if (at - EDGE < from || size > room) return at - EDGE - from;
      return Math.max(0, at + size + EDGE - from - room);
    };
    const isIn = meet([left, top, wide, high], [x, y, width, height]);
    if (isIn && (width > wide || height > high)) return;
    this.element.scrollLeft += by(x, width, left, wide) * this.zoom;
    this.element.scrollTop += by(y, height, top, high) * this.zoom;
  }
}

/** Whether two frames have something in common. */
export function meet(a: Frame, b: Frame): boolean {
  return a[0] <= b[0] + b[2] && b[0] <= a[0] + a[2] && a[1] <= b[1] + b[3] && b[1] <= a[1] + a[3];
}

// Scrolls on while a drag is held at the edge of what can be seen. What the drag does meanwhile is
// not known here.
import type { Point } from "./drawn";

/** So near to the edge it begins, in pixels. */
const NEAR = 24;
/** So long the pointer is there before, in milliseconds: what is dropped at the edge stays there. */
const HELD = 400;
/** At the edge, in pixels a millisecond; nearer to the middle slower. */
const SPEED = 0.8;
/** A frame that comes late scrolls no farther than this one, in milliseconds. */
const FRAME_MAX = 50;

export class Autoscroll {
  private event: PointerEvent | undefined;
  private frame = 0;
  private last = 0;

  /** `scrolled` is told of the pointer, which is over another part of the drawing now. */
  constructor(
    private element: HTMLElement,
    private scrolled: (event: PointerEvent) => void,
  ) {}

  /** The pointer of a drag is here. */
  follow(event: PointerEvent): void {
    this.event = event;
    if (this.frame !== 0) return;
    this.last = performance.now() + HELD;
    this.frame = requestAnimationFrame((now) => this.step(now));
  }

  stop(): void {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    this.event = undefined;
  }

  private step(now: number): void {
    const { event, element } = this;
    this.frame = 0;
    const [dx, dy] = event ? this.speed(event) : [0, 0];
    if (!event || (dx === 0 && dy === 0)) return;
    const time = Math.min(Math.max(now - this.last, 0), FRAME_MAX);
    this.last = Math.max(this.last, now);
    const { scrollLeft, scrollTop } = element;
    element.scrollBy(dx * time, dy * time);
    if (element.scrollLeft !== scrollLeft || element.scrollTop !== scrollTop) this.scrolled(event);
    this.frame = requestAnimationFrame((next) => this.step(next));
  }

  private speed({ clientX, clientY }: PointerEvent): Point {
    const { left, right, top, bottom } = this.element.getBoundingClientRect();
    return [along(clientX, left, right), along(clientY, top, bottom)];
  }
}

/** How fast at a place between two edges: backward at the first one, forward at the other. */
function along(at: number, from: number, to: number): number {
  const deep = (beyond: number) => Math.min(Math.max(beyond / NEAR, 0), 1);
  return SPEED * (deep(at - (to - NEAR)) - deep(from + NEAR - at));
}

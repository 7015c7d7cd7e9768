// All of a drawing in a corner, with the part that can be seen; it can be folded.
import { button, h, say } from "../page/dom";
import { colour, onTheme } from "../page/theme";
import type { ChartEditor } from "./editor";

/** As large as it gets, in pixels. */
const SIZE = 110;

export class Minimap {
  private canvas = h("canvas", { attributes: { "aria-hidden": "true" } });
  private view = h("div", { class: "view" });
  private map = h(
    "div",
    {
      class: "map",
      on: { pointerdown: (event) => this.go(event), pointermove: (event) => this.go(event) },
    },
    this.canvas,
    this.view,
  );
  private fold = button("chartMap", () => this.folded(!this.map.hidden), { class: "small" });
  readonly element = h("div", { class: "minimap" }, this.map, this.fold);
  private scale = 1;

  constructor(private editor: ChartEditor) {
    editor.canvas.onView(() => this.place());
    onTheme(() => this.draw());
    this.folded(false);
  }

  private folded(isFolded: boolean): void {
    this.map.hidden = isFolded;
    this.fold.setAttribute("aria-expanded", String(!isFolded));
    say(this.fold, "title", "chartMap");
    this.draw();
  }

  /** Draws all steps. */
  draw(): void {
    const { canvas: drawing, document, only } = this.editor;
    const [left, top, width, height] = drawing.bounds;
    const context = this.canvas.getContext("2d");
    if (this.map.hidden || !context) return;
    this.scale = Math.min(SIZE / width, SIZE / height);
    const sharp = devicePixelRatio;
    this.canvas.width = Math.max(1, width * this.scale * sharp);
    this.canvas.height = Math.max(1, height * this.scale * sharp);
    this.canvas.style.width = `${width * this.scale}px`;
    this.canvas.style.height = `${height * this.scale}px`;
    context.scale(this.scale * sharp, this.scale * sharp);
    context.translate(-left, -top);
    context.fillStyle = colour("strong-border");
    const least = 1 / this.scale;
    for (const item of document.drawn?.items ?? []) {
      if (item.kind !== "step" || (only !== null && only !== item.sheet)) continue;
      const [x, y, wide, high] = item.element.frame;
      context.fillRect(x, y, Math.max(wide, least), Math.max(high, least));
    }
    this.place();
  }

  private place(): void {
    const { canvas } = this.editor;
    const [left, top, width, height] = canvas.bounds;
    const [x, y, wide, high] = canvas.view();
    // What fits needs no map.
    this.element.hidden = wide >= width && high >= height;
    const { style } = this.view;
    style.left = `${Math.max(0, x - left) * this.scale}px`;
    style.top = `${Math.max(0, y - top) * this.scale}px`;
    style.width = `${Math.min(wide, width) * this.scale}px`;
    style.height = `${Math.min(high, height) * this.scale}px`;
  }

  /** What is pressed comes to the middle. */
  private go(event: PointerEvent): void {
    if (event.buttons !== 1) return;
    event.preventDefault();
    const { left, top } = this.canvas.getBoundingClientRect();
    const { bounds } = this.editor.canvas;
    this.editor.canvas.centre([
      bounds[0] + (event.clientX - left) / this.scale,
      bounds[1] + (event.clientY - top) / this.scale,
    ]);
  }
}

// The handle below the step that has the focus: a drag from it draws a transition.
import { s } from "../page/dom";
import type { ChartEditor } from "./editor";

/** What is seen of it, and what a finger finds, in pixels. */
const RADIUS = 5;
const REACH = 24;
/** In a smaller drawing there is no room for it. */
const ZOOM_MIN = 0.5;

export class Handle {
  private reach = s("rect", {
    x: -REACH / 2,
    y: -RADIUS,
    width: REACH,
    height: REACH,
    class: "reach",
  });
  private dot = s("circle", { r: RADIUS, class: "dot" });
  private element = s("g", { class: "handle" }, this.reach, this.dot);

  constructor(private editor: ChartEditor) {
    editor.canvas.overlay.append(this.element);
    editor.canvas.onView(() => this.show());
  }

  private show(): void {
    const { scene, canvas } = this.editor;
    const [item, other] = scene?.items ?? [];
    const isThere =
      item?.kind === "step" && !other && scene?.drawn.isEditable && canvas.zoom >= ZOOM_MIN;
    this.element.toggleAttribute("hidden", !isThere);
    if (!isThere || item?.kind !== "step") return;
    const [x, y, width, height] = item.element.frame;
    const scale = 1 / canvas.zoom;
    const at = `translate(${x + width / 2} ${y + height}) scale(${scale}) translate(0 ${RADIUS})`;
    this.element.setAttribute("transform", at);
  }
}

// What is around several drawings: the size, and what keeps something from being drawn.
import { button, h, iconButton } from "../page/dom";
import type { Ground } from "../page/ground";
import { icon } from "../page/icons";

/** Buttons that change the size of a drawing. */
export function zoomButtons(ground: Ground): HTMLElement[] {
  return [
    iconButton(icon("smaller"), "drawingSmaller", () => ground.zoomBy(-1)),
    iconButton(icon("add"), "drawingLarger", () => ground.zoomBy(1)),
    iconButton(icon("fit"), "drawingFit", () => ground.fit()),
  ];
}

/** What keeps a text from being drawn, with the way to its line where it has one. */
export class Obstacle {
  readonly element = h("p", { class: "obstacle", attributes: { role: "status" } });

  constructor(private goTo: (line: number) => void) {}

  show(words: string, line?: number): void {
    const go = line !== undefined && button("showPlace", () => this.goTo(line));
    this.element.replaceChildren(h("span", {}, words), ...(go ? [go] : []));
    this.element.hidden = words === "";
  }
}

// The whole drawing as a picture that stands for itself: for a file, or for paper.
import { h, s } from "../page/dom";
import type { Canvas } from "./canvas";
import type { Drawn } from "./drawn";
import { savePng, saveSvg, settle, stemOf } from "./paper";
import { Shape, title } from "./shape";

/** What is drawn, of all charts or one: complete. */
function picture(drawn: Drawn, canvas: Canvas, only: number | null): SVGSVGElement {
  const [x, y, width, height] = canvas.bounds;
  const svg = s("svg", { width, height, viewBox: `${x} ${y} ${width} ${height}` });
  svg.append(s("rect", { x, y, width, height, fill: "#ffffff" }));
  const isShown = (sheet: number) => only === null || only === sheet;
  for (const [at, sheet] of drawn.charts.sheets.entries())
    if (isShown(at) && !sheet.isFolded) svg.append(title(sheet.title, sheet.name));
  for (const kind of ["transition", "step"])
    for (const item of drawn.items)
      if (item.kind === kind && isShown(item.sheet)) svg.append(new Shape(item).picture);
  return settle(svg, canvas.ground, canvas.svg.getAttribute("class") ?? "");
}

export class Pictures {
  constructor(
    private canvas: Canvas,
    private shown: () => { drawn: Drawn | null; only: number | null; file: string | null },
  ) {}

  private made(): { svg: SVGSVGElement; name: string } | null {
    const { drawn, only, file } = this.shown();
    if (!drawn || file === null) return null;
    return { svg: picture(drawn, this.canvas, only), name: stemOf(file) };
  }

  svg(): void {
    const made = this.made();
    if (made) saveSvg(made.svg, made.name);
  }

  async png(): Promise<void> {
    const made = this.made();
    if (made) await savePng(made.svg, made.name);
  }

  /** Gives the drawing, and nothing else of the page, to the printer. */
  print(): void {
    const made = this.made();
    if (!made) return;
    const paper = h("div", { class: "paper" }, made.svg);
    document.body.append(paper);
    addEventListener("afterprint", () => paper.remove(), { once: true });
    print();
  }
}

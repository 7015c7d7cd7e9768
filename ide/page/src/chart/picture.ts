// The whole drawing as a picture that stands for itself: for a file, in SVG or PNG, or for paper.
import { h, s } from "../page/dom";
import { notice } from "../page/notices";
import { save } from "../project/files";
import { t } from "../text/language";
import type { Canvas } from "./canvas";
import type { Drawn } from "./drawn";
import type { Frame } from "./protocol";
import { Shape, title } from "./shape";

/** What a style sheet says of a node and a file has to say itself. */
const STYLES = [
  ...["fill", "stroke", "stroke-width", "font-family", "font-size", "font-weight"],
  ...["text-anchor", "dominant-baseline"],
];
/** A canvas of a browser is no larger, in pixels. */
const SIDE_MAX = 8192;
const SHARP = 2;

/** What is drawn, of all charts or one: complete, in the colours of paper. */
function picture(drawn: Drawn, canvas: Canvas, only: number | null): SVGSVGElement {
  const [x, y, width, height] = canvas.bounds;
  const svg = s("svg", { width, height, viewBox: `${x} ${y} ${width} ${height}` });
  svg.append(s("rect", { x, y, width, height, fill: "#ffffff" }));
  const isShown = (sheet: number) => only === null || only === sheet;
  for (const [at, sheet] of drawn.charts.sheets.entries())
    if (isShown(at)) svg.append(title(sheet.title, sheet.name));
  for (const kind of ["transition", "step"])
    for (const item of drawn.items)
      if (item.kind === kind && isShown(item.sheet)) svg.append(new Shape(item).picture);
  const host = h("div", { class: canvas.svg.getAttribute("class") ?? "" }, svg);
  canvas.ground.append(host);
  const { dataset } = document.documentElement;
  const theme = dataset["theme"];
  dataset["theme"] = "light";
  for (const node of [...svg.querySelectorAll("g, text, path, rect")]) style(node);
  dataset["theme"] = theme;
  host.remove();
  return svg;
}

function style(node: Element): void {
  const computed = getComputedStyle(node);
  if (computed.display === "none") return node.remove();
  if (!node.matches("g"))
    for (const name of STYLES) node.setAttribute(name, computed.getPropertyValue(name));
  node.removeAttribute("class");
}

export class Pictures {
  constructor(
    private canvas: Canvas,
    private shown: () => { drawn: Drawn | null; only: number | null; file: string | null },
  ) {}

  private made(): { svg: SVGSVGElement; name: string; bounds: Frame } | null {
    const { drawn, only, file } = this.shown();
    if (!drawn || file === null) return null;
    const svg = picture(drawn, this.canvas, only);
    return {
      svg,
      name: file.replace(/^.*\//, "").replace(/\.\w+$/, ""),
      bounds: this.canvas.bounds,
    };
  }

  svg(): void {
    const made = this.made();
    if (made) save(`${made.name}.svg`, textOf(made.svg), "image/svg+xml");
  }

  async png(): Promise<void> {
    const made = this.made();
    if (!made) return;
    const [, , width, height] = made.bounds;
    const scale = Math.min(SHARP, SIDE_MAX / width, SIDE_MAX / height);
    const image = new Image();
    image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(textOf(made.svg))}`;
    await image.decode();
    const canvas = h("canvas", { set: { width: width * scale, height: height * scale } });
    canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
    const blob = await new Promise<Blob | null>((done) => canvas.toBlob(done, "image/png"));
    if (blob) save(`${made.name}.png`, blob, "image/png");
    else notice(t("noPicture"), true);
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

function textOf(svg: SVGSVGElement): string {
  return new XMLSerializer().serializeToString(svg);
}

// A picture that stands for itself, in the colours of paper: for a file, in SVG or PNG. What is on it
// is not known here.
import { h } from "../page/dom";
import { notice } from "../page/notices";
import { save } from "../project/files";
import { t } from "../text/language";

/** What a style sheet says of a node and a file has to say itself. */
const STYLES = [
  ...["fill", "stroke", "stroke-width", "font-family", "font-size", "font-weight"],
  ...["text-anchor", "dominant-baseline"],
];
/** A canvas of a browser is no larger, in pixels. */
const SIDE_MAX = 8192;
const SHARP = 2;

/** Writes into a picture how it looks in a place of the page, in the light theme. */
export function settle(svg: SVGSVGElement, place: Element, classes: string): SVGSVGElement {
  const host = h("div", { class: classes }, svg);
  place.append(host);
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

export function saveSvg(svg: SVGSVGElement, name: string): void {
  save(`${name}.svg`, textOf(svg), "image/svg+xml");
}

export async function savePng(svg: SVGSVGElement, name: string): Promise<void> {
  const { width, height } = svg.viewBox.baseVal;
  const scale = Math.min(SHARP, SIDE_MAX / width, SIDE_MAX / height);
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(textOf(svg))}`;
  await image.decode();
  const canvas = h("canvas", { set: { width: width * scale, height: height * scale } });
  canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
  const blob = await new Promise<Blob | null>((done) => canvas.toBlob(done, "image/png"));
  if (blob) save(`${name}.png`, blob, "image/png");
  else notice(t("noPicture"), true);
}

function textOf(svg: SVGSVGElement): string {
  return new XMLSerializer().serializeToString(svg);
}

/** The name of a file without its folders and its ending. */
export function stemOf(file: string): string {
  return file.replace(/^.*\//, "").replace(/\.\w+$/, "");
}

// Pictures for buttons, drawn in the colour of their text.
import { s } from "./dom";

const PATHS = {
  run: "M5 3.5v9l7.5-4.5z",
  stop: "M4 4h8v8H4z",
  pause: "M4 3.5h3v9H4zM9 3.5h3v9H9z",
  step: "M3.5 3.5v9L9.5 8zM10.5 3.5h2v9h-2z",
  reset: "M8 2.5a5.5 5.5 0 1 0 5.4 4.5h-1.9A3.7 3.7 0 1 1 8 4.3V6.5L11.6 3.4 8 .5z",
  download: "M7 2h2v6h2.6L8 11.8 4.4 8H7zM3 12.5h10V14H3z",
  connect: "M5 1.5h1.6V5h2.8V1.5H11V5h1v3.5L9.5 11v3.5h-3V11L4 8.5V5h1z",
  menu: "M2 3.5h12V5H2zM2 7.2h12v1.6H2zM2 11h12v1.5H2z",
  close:
    "m4.2 3.1 3.8 3.8 3.8-3.8 1.1 1.1L9.1 8l3.8 3.8-1.1 1.1L8 9.1l-3.8 3.8-1.1-1.1L6.9 8 3.1 4.2z",
  add: "M7.2 3h1.6v4.2H13v1.6H8.8V13H7.2V8.8H3V7.2h4.2z",
  more: "M3.5 6.6a1.4 1.4 0 1 1 0 2.8 1.4 1.4 0 0 1 0-2.8zm4.5 0a1.4 1.4 0 1 1 0 2.8 1.4 1.4 0 0 1 0-2.8zm4.5 0a1.4 1.4 0 1 1 0 2.8 1.4 1.4 0 0 1 0-2.8z",
  split: "M2 2.5h12v11H2zM3.5 4v8h3.8V4zm5.2 0v8h3.8V4z",
  settings:
    "M2 4h6.3a2 2 0 0 1 3.4 0H14v1.5h-2.3a2 2 0 0 1-3.4 0H2zm0 6.5h2.3a2 2 0 0 1 3.4 0H14V12H7.7a2 2 0 0 1-3.4 0H2z",
  help: "M7.1 11.4h1.8v1.9H7.1zM8 2.6c2.2 0 3.7 1.3 3.7 3.1 0 1.4-.8 2.2-1.7 2.8-.8.5-1.1.8-1.1 1.6H7.1c0-1.6.6-2.3 1.7-3 .7-.5 1-.8 1-1.4 0-.8-.7-1.4-1.8-1.4-1.200 0-1.900.7-2 1.700H4.200C4.300 4 5.700 2.600 8 2.600z",
  stepAfter: "M3 2h10v5H8.8v2.3H12L8 13.5 4 9.3h3.2V7H3zM4.5 3.5v2h7v-2z",
  undo: "M6.2 2.6v2.6h3.3a4 4 0 0 1 0 8H5v-1.7h4.5a2.3 2.3 0 0 0 0-4.6H6.2v2.6L2 6z",
  redo: "M9.8 2.6v2.6H6.5a4 4 0 0 0 0 8H11v-1.7H6.5a2.3 2.3 0 0 1 0-4.6h3.3v2.6L14 6z",
  back: "M11 3.5v9L3.5 8z",
  smaller: "M3 7.2h10v1.6H3z",
  fit: "M2 2h4v1.5H3.5V6H2zM10 2h4v4h-1.5V3.5H10zM2 10h1.5v2.5H6V14H2zM12.5 10H14v4h-4v-1.5h2.5z",
} as const;

export type Icon = keyof typeof PATHS;

/** A picture of 16 by 16. */
export function icon(name: Icon): SVGSVGElement {
  return s(
    "svg",
    { viewBox: "0 0 16 16", width: 16, height: 16, "aria-hidden": "true", class: "icon" },
    s("path", { d: PATHS[name], "fill-rule": "evenodd" }),
  );
}

// Which colours a file has, by the ending of its name.
import type { Extension } from "@codemirror/state";
import { awl, plant, scenario } from "./awl";
import { charts, structuredText } from "./structured";
import { xml } from "./xml";

const LANGUAGES: Record<string, Extension> = {
  awl,
  st: structuredText,
  sfc: charts,
  fbd: structuredText,
  fbt: xml,
  scn: scenario,
  plant,
};

/** The colours for a file of this name. */
export function colours(file: string): Extension {
  return LANGUAGES[file.split(".").pop()?.toLowerCase() ?? ""] ?? [];
}

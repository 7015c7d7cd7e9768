// Words that all drawings have: English, German, Spanish. They are loaded with the first one.
import type { Words } from "./language";

export const DRAWING_WORDS = {
  drawingSmaller: ["Smaller", "Kleiner", "Más pequeño"],
  drawingLarger: ["Larger", "Größer", "Más grande"],
  drawingFit: ["Fit", "Einpassen", "Ajustar"],
} as const satisfies Record<string, Words>;

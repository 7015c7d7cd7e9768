// The words of diagrams of blocks: English, German, Spanish. They are loaded with them.
import type { Words } from "./language";

export const DIAGRAM_WORDS = {
  diagramNothing: [
    "The diagrams of blocks of a file are drawn here, where the editor has one with diagrams (.fbd).",
    "Hier werden die Bausteinpläne einer Datei gezeichnet, wenn der Editor eine mit solchen zeigt (.fbd).",
    "Aquí se dibujan los diagramas de bloques de un archivo, si el editor muestra uno que los tiene (.fbd).",
  ],
  diagramOf: ["diagram {0}", "Bausteinplan {0}", "diagrama {0}"],
  diagramElement: ["{0}: {1} {2}", "{0}: {1} {2}", "{0}: {1} {2}"],
  diagramTools: ["Diagram tools", "Werkzeuge des Bausteinplans", "Herramientas del diagrama"],
  diagramSmaller: ["Smaller", "Kleiner", "Más pequeño"],
  diagramLarger: ["Larger", "Größer", "Más grande"],
  diagramFit: ["Fit", "Einpassen", "Ajustar"],
  diagramDetails: ["Chosen element", "Gewähltes Element", "Elemento elegido"],
  diagramInputs: ["Inputs", "Eingänge", "Entradas"],
  diagramOutputs: ["Outputs", "Ausgänge", "Salidas"],
  diagramParameters: ["Parameters", "Parameter", "Parámetros"],
  diagramPlot: ["Plot", "Zeichnen", "Trazar"],
  diagramPlotOf: ["Plot {0}", "{0} zeichnen", "Trazar {0}"],
  diagramSlider: ["Slider for {0}", "Schieber für {0}", "Deslizador de {0}"],
} as const satisfies Record<string, Words>;

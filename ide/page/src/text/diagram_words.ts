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
  diagramBlocks: ["Blocks", "Bausteine", "Bloques"],
  diagramAddBlock: ["Block…", "Baustein…", "Bloque…"],
  diagramSearch: ["Search for a block", "Baustein suchen", "Buscar un bloque"],
  diagramNoBlock: [
    "No block is called so.",
    "So heißt kein Baustein.",
    "Ningún bloque se llama así.",
  ],
  diagramPins: [
    "inputs: {0}; outputs: {1}",
    "Eingänge: {0}; Ausgänge: {1}",
    "entradas: {0}; salidas: {1}",
  ],
  diagramClose: ["Close", "Schließen", "Cerrar"],
  diagramAddWritten: ["Assignment…", "Zuweisung…", "Asignación…"],
  diagramWritten: [
    "A call or an assignment, such as %Q0.0 := Loop.Q",
    "Ein Aufruf oder eine Zuweisung, wie %Q0.0 := Regler.Q",
    "Una llamada o una asignación, como %Q0.0 := Lazo.Q",
  ],
  diagramAdd: ["Add", "Hinzufügen", "Añadir"],
  diagramRemove: ["Remove", "Entfernen", "Quitar"],
  diagramUndo: ["Undo", "Rückgängig", "Deshacer"],
  diagramRedo: ["Redo", "Wiederholen", "Rehacer"],
  diagramChanged: [
    "The text has changed meanwhile. Try it again.",
    "Der Text hat sich inzwischen geändert. Versuchen Sie es noch einmal.",
    "El texto ha cambiado mientras tanto. Inténtelo otra vez.",
  ],
  diagramEmpty: [
    "There is no block yet: add one.",
    "Es gibt noch keinen Baustein: Fügen Sie einen hinzu.",
    "Aún no hay ningún bloque: añada uno.",
  ],
  diagramValueOf: ["What is given to {0}", "Was {0} bekommt", "Lo que recibe {0}"],
  diagramSmaller: ["Smaller", "Kleiner", "Más pequeño"],
  diagramLarger: ["Larger", "Größer", "Más grande"],
  diagramFit: ["Fit", "Einpassen", "Ajustar"],
  diagramDetails: ["Chosen element", "Gewähltes Element", "Elemento elegido"],
  diagramInputs: ["Inputs", "Eingänge", "Entradas"],
  diagramOutputs: ["Outputs", "Ausgänge", "Salidas"],
  diagramParameters: ["Parameters", "Parameter", "Parámetros"],
  diagramPlot: ["Plot", "Zeichnen", "Trazar"],
  diagramPlotOf: ["Plot {0}", "{0} zeichnen", "Trazar {0}"],
  diagramKeep: ["Keep", "Behalten", "Conservar"],
  diagramKeepOf: [
    "Keep the value of {0} in the text",
    "Den Wert von {0} im Text behalten",
    "Conservar el valor de {0} en el texto",
  ],
  diagramSlider: ["Slider for {0}", "Schieber für {0}", "Deslizador de {0}"],
} as const satisfies Record<string, Words>;

// The words of blocks of IEC 61499: English, German, Spanish. They are loaded with them.
import type { Words } from "./language";

export const EVENT_WORDS = {
  eventsChartOf: ["chart of {0}, in {1}", "Plan von {0}, in {1}", "diagrama de {0}, en {1}"],
  eventsTools: ["Tools of the block", "Werkzeuge des Bausteins", "Herramientas del bloque"],
  eventsSend: ["Send an event", "Ereignis senden", "Enviar un evento"],
  eventsLog: ["What came of it", "Was daraus wurde", "Lo que resultó"],
  eventsAnew: ["Begin anew", "Neu beginnen", "Empezar de nuevo"],
  eventsBack: ["Take the last back", "Letztes zurücknehmen", "Deshacer lo último"],
  eventsInputs: ["Inputs", "Eingänge", "Entradas"],
  eventsOutputs: ["Outputs", "Ausgänge", "Salidas"],
  eventsInternals: ["Own variables", "Eigene Variablen", "Variables propias"],
} as const satisfies Record<string, Words>;

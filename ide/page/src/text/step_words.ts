// The words of step responses: English, German, Spanish. They are loaded with them.
import type { Words } from "./language";

export const STEP_WORDS = {
  stepHint: [
    "From cursor A to cursor B where both are set, otherwise of all that is plotted. The step is the last change of the set value; without one it is the beginning.",
    "Von Cursor A bis Cursor B, wenn beide gesetzt sind, sonst von allem, was gezeichnet ist. Der Sprung ist die letzte Änderung des Sollwerts; ohne eine ist er der Anfang.",
    "Del cursor A al cursor B si ambos están puestos; si no, de todo lo trazado. El escalón es el último cambio de la consigna; sin ninguno es el comienzo.",
  ],
  stepSignal: ["Signal that answers", "Signal, das antwortet", "Señal que responde"],
  stepWanted: ["Set value", "Sollwert", "Consigna"],
  stepNone: ["none", "keiner", "ninguna"],
  stepNumber: ["a number", "eine Zahl", "un número"],
  stepValue: ["Number", "Zahl", "Número"],
  stepBegin: ["Step at", "Sprung bei", "Escalón en"],
  stepBefore: ["Value before", "Wert davor", "Valor antes"],
  stepAfter: ["Value after", "Wert danach", "Valor después"],
  stepRise: [
    "Rise time, 10 % to 90 %",
    "Anstiegszeit, 10 % bis 90 %",
    "Tiempo de subida, 10 % a 90 %",
  ],
  stepOvershoot: ["Overshoot", "Überschwingen", "Sobreoscilación"],
  stepSettling: [
    "Settling time, to within 2 %",
    "Einschwingzeit, bis auf 2 %",
    "Tiempo de establecimiento, al 2 %",
  ],
  stepError: ["Steady-state error", "Bleibende Abweichung", "Error estacionario"],
  stepIae: [
    "IAE: integral of the absolute error",
    "IAE: Integral des Betrags der Abweichung",
    "IAE: integral del error absoluto",
  ],
  "step-constant": [
    "The value after is the one before: there is no step.",
    "Der Wert danach ist der davor: Es gibt keinen Sprung.",
    "El valor después es el de antes: no hay escalón.",
  ],
  "step-restless": [
    "It has not settled: in the last fifth of the time it is not within 2 % of a last value.",
    "Es hat sich nicht beruhigt: Im letzten Fünftel der Zeit liegt es nicht innerhalb von 2 % um einen Endwert.",
    "No se ha establecido: en el último quinto del tiempo no está dentro del 2 % de un valor final.",
  ],
  "step-nothing": [
    "There are too few samples for figures.",
    "Für Kennwerte gibt es zu wenige Werte.",
    "Hay muy pocas muestras para calcularlas.",
  ],
  stepMissing: [
    "For {0} s there are no samples: that time is in no figure.",
    "Für {0} s gibt es keine Werte: Diese Zeit ist in keinem Kennwert.",
    "Durante {0} s no hay muestras: ese tiempo no está en ninguna característica.",
  ],
} as const satisfies Record<string, Words>;

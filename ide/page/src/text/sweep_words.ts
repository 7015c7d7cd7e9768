// The words of frequency responses: English, German, Spanish. They are loaded with them.
import type { Words } from "./language";

export const SWEEP_WORDS = {
  sweepHint: [
    "Simulated apart from the target: a sine goes into what the program only reads, such as a set value; gain and phase lead are those from the beginning of the path to its end. The step in ms is the one above.",
    "Getrennt vom Ziel simuliert: Ein Sinus geht in etwas, das das Programm nur liest, etwa einen Sollwert; Verstärkung und Phase sind die vom Anfang des Pfads bis zu seinem Ende. Der Schritt in ms ist der von oben.",
    "Se simula aparte del destino: un seno entra en algo que el programa solo lee, como una consigna; ganancia y fase son las del principio al fin del camino. El paso en ms es el de arriba.",
  ],
  sweepExcite: ["Excite", "Anregen", "Excitar"],
  sweepFrom: [
    "Path from (empty: what is excited)",
    "Pfad von (leer: Angeregtes)",
    "Camino desde (vacío: lo excitado)",
  ],
  sweepTo: ["Path to", "Pfad bis", "Camino hasta"],
  sweepLow: ["From Hz", "Von Hz", "Desde Hz"],
  sweepHigh: ["To Hz", "Bis Hz", "Hasta Hz"],
  sweepAmplitude: ["Amplitude", "Amplitude", "Amplitud"],
  sweepOffset: ["Offset", "Mittelwert", "Valor medio"],
  sweepMeasure: ["Measure", "Messen", "Medir"],
  sweeping: ["Measuring…", "Es wird gemessen…", "Midiendo…"],
  sweepGain: ["Gain in dB", "Verstärkung in dB", "Ganancia en dB"],
  sweepPhase: ["Phase in degrees", "Phase in Grad", "Fase en grados"],
  sweepBandwidth: ["Bandwidth, -3 dB", "Bandbreite, -3 dB", "Ancho de banda, -3 dB"],
  sweepPhaseMargin: ["Phase margin, at 0 dB", "Phasenreserve, bei 0 dB", "Margen de fase, a 0 dB"],
  sweepGainMargin: [
    "Gain margin, at -180°",
    "Amplitudenreserve, bei -180°",
    "Margen de ganancia, a -180°",
  ],
  sweepAt: ["{0} at {1} Hz", "{0} bei {1} Hz", "{0} a {1} Hz"],
  sweepPoint: [
    "{0} Hz: {1} dB, {2}°, distortion {3} %",
    "{0} Hz: {1} dB, {2}°, Verzerrung {3} %",
    "{0} Hz: {1} dB, {2}°, distorsión {3} %",
  ],
  sweepUnsettled: [
    "Not settled at {0} Hz: what came out there never repeated itself.",
    "Nicht eingeschwungen bei {0} Hz: Was dort herauskam, hat sich nie wiederholt.",
    "Sin establecerse a {0} Hz: lo que salió allí no se repitió nunca.",
  ],
  sweepDistorted: [
    "Up to {0} % of what comes out is no sine: a limit is reached, or the samples are too far apart.",
    "Bis zu {0} % von dem, was herauskommt, ist kein Sinus: Eine Grenze ist erreicht, oder die Abtastung ist zu grob.",
    "Hasta un {0} % de lo que sale no es seno: se llega a un límite, o las muestras están demasiado separadas.",
  ],
} as const satisfies Record<string, Words>;

// What the page asks of the core and what it is told, as ide/core/src/protocol.rs has it; what each
// means is written there.

import type { Parity } from "../ports/port";
import type { Words } from "../text/language";

export type TargetKind = "simulator" | "virtualUno" | "usb" | "bridge";

export interface File {
  name: string;
  text: string;
}

export interface Place {
  file: string;
  from: number;
  to: number;
}

export interface Problem extends Place {
  code: string;
  isError: boolean;
  line: number;
  column: number;
  message: string;
  help: string[];
  suggestion: string | null;
  related: [Place, string][];
}

export interface Completion {
  label: string;
  kind: string;
  detail: string;
  info: string;
  /** What is written, and where something is to be written in that. */
  insert: string;
  holes: number[];
  from: number;
}

export interface Hover {
  text: string;
  from: number;
  to: number;
}

export interface Edit extends Place {
  text: string;
}

export interface Item {
  name: string;
  kind: string;
  line: number;
  from: number;
}

export interface Summary {
  file: string;
  files: string[];
  instructions: number;
  bytes: number;
  bytesMax: number;
  data: number;
  dataMax: number;
  longestUs: number | null;
  fitsUno: boolean;
  operands: [string, string][];
}

export interface Status {
  target: TargetKind;
  mode: string;
  loading: { phase: string; percent: number } | null;
  agreement: string;
  scans: number;
  timeMs: number;
  pace: number | null;
  scanUs: [number, number, number] | null;
  fault: string | null;
  faultAt: Place | null;
  lost: string | null;
}

export interface Value {
  name: string;
  text: string;
  number: number | null;
  form: string;
  forced: boolean;
  canForce: boolean;
  problem: string | null;
}

export interface Line {
  line: number;
  flow: string | null;
  values: Value[];
}

export interface LadderPin {
  name: string;
  side: "above" | "below" | "left" | "right";
  text: string;
  other: string | null;
  comment: string;
}

export interface LadderElement {
  shape: "contact" | "coil" | "box";
  symbol: string;
  mnemonic: string;
  isSwitch: boolean;
  line: number;
  column: number;
  row: number;
  columns: number;
  rows: number;
  powers: [name: string, row: number, net: number][];
  output: number | null;
  pins: LadderPin[];
}

export interface LadderRung {
  lines: [number, number];
  obstacle: { line: number; why: string; message: string } | null;
  columns: number;
  rows: number;
  elements: LadderElement[];
  wires: { net: number; from: [number, number]; to: [number, number] }[];
}

export interface Ladder {
  id: number;
  file: string;
  number: number | null;
  title: string;
  lines: [number, number];
  first: number;
  count: number;
  rungs: LadderRung[];
}

export interface Power {
  nets: (boolean | null)[];
  elements: (boolean | null)[];
}

/** Charts whose steps are told. */
export interface Chart {
  id: number;
  file: string;
}

/** How charts are at the end of a scan. */
export interface Moment {
  timeMs: number;
  scan: number;
  steps: (boolean | null)[][];
  values: (number | null)[];
}

export interface Recording {
  names: string[];
  times: number[];
  columns: (number | null)[][];
  figures: (number | null)[][];
  csv: string;
  vcd: string;
  plant: string | null;
  gaps: number;
}

/** The path whose frequency response is measured; frequencies in Hz. */
export interface Path {
  excite: string;
  from: string | null;
  to: string;
  low: number;
  high: number;
  amplitude: number;
  offset: number;
}

/** A value for each frequency: gains in dB, phases in degrees, null where nothing comes out. */
export interface FrequencyResponse {
  frequencies: number[];
  gains: (number | null)[];
  phases: (number | null)[];
  distortions: number[];
  settled: boolean[];
  figures: {
    bandwidth: number | null;
    /** Where, and how much. */
    phaseMargin: [number, number] | null;
    gainMargin: [number, number] | null;
  };
  csv: string;
}

/** Something in a plant that can be set. */
export interface Control {
  name: string;
  words: Words;
  kind: "button" | "switch" | "slider" | "fault";
  low: number;
  high: number;
  value: number;
}

/** Something that a plant file draws. */
export interface Shape {
  kind: string;
  at: [number, number];
  size: number[];
  words: Words | null;
  colour: string;
  by: [number, number];
}

export interface PlantInfo {
  title: Words;
  digital: number;
  analog: number;
  controls: Control[];
  shapes: Shape[];
}

export interface TestResult {
  goal: Words | null;
  passed: boolean;
  scans: number;
  met: number;
  failures: [number, string][];
  plant: string | null;
}

interface At {
  file: string;
  at: number;
}

/** What is answered, and with what. */
export interface Questions {
  complete: { wish: At; answer: Completion[] };
  hover: { wish: At; answer: Hover | null };
  definition: { wish: At; answer: Place | null };
  references: { wish: At; answer: Place[] };
  renameSymbol: { wish: At & { to: string }; answer: Edit[] };
  format: { wish: { file: string }; answer: Edit[] };
  outline: { wish: { file: string }; answer: Item[] };
  ladder: { wish: At; answer: Ladder | null };
  chart: { wish: { file: string; values: string[] }; answer: Chart | null };
  aboutPlant: { wish: { spec: string }; answer: PlantInfo };
  simulate: {
    wish: { signals: string[]; forMs: number; scanMs: number; plant: string | null };
    answer: Recording;
  };
  sweep: {
    wish: { path: Path; scanMs: number; plant: string | null };
    answer: FrequencyResponse;
  };
  test: { wish: { file: string }; answer: TestResult };
  check: { wish: { name: string; text: string; plants: File[] }; answer: TestResult };
}

/** What is done without an answer, unless it is refused. */
export interface Orders {
  open: { files: File[]; main: string | null };
  edit: { file: string; text: string };
  remove: { file: string };
  rename: { file: string; to: string };
  choose: { main: string };
  target: { kind: TargetKind };
  connect: object;
  downloadFirmware: object;
  plugged: { network: boolean };
  unplugged: { why: string };
  disconnect: object;
  download: object;
  run: object;
  stop: object;
  pause: { on: boolean };
  singleScan: object;
  reset: object;
  speed: { factor: number };
  plant: { spec: string | null };
  handle: { name: string; value: number };
  drive: { operand: string; value: number };
  activate: { step: string; on: boolean };
  set: { operand: string; value: string };
  force: { operand: string; value: string };
  unforce: { operand: string | null };
  watch: { operands: string[] };
  view: { file: string; from: number; to: number };
  scope: { signals: string[]; everyMs: number };
  record: { signals: string[]; everyMs: number; forMs: number };
  endRecording: object;
}

interface Events {
  answer: { id: number; answer: unknown };
  refused: { id: number; message: string };
  problems: { problems: Problem[] };
  program: { program: Summary | null };
  status: { status: Status };
  live: { file: string; lines: Line[] };
  power: { id: number; rungs: Power[] };
  situation: Moment & { id: number; before: Moment[]; lost: boolean };
  watched: { values: Value[] };
  forced: { values: Value[] };
  pins: { inputs: number; outputs: number; analog: number[]; pwm: number[] };
  plant: { name: string; state: [string, number][]; places: number[][]; news: string[] };
  samples: { times: number[]; columns: number[][]; lost: boolean };
  recording: { doneMs: number; gaps: number };
  recorded: { recording: Recording; ended: string | null };
  send: { bytes: number[] };
  powerOn: { flash: number[] };
  powerOff: object;
  resetBoard: object;
  openPort: { kind: TargetKind; baud: number; parity: Parity };
  closePort: object;
  lines: { on: boolean };
  askFirmware: object;
  notice: { message: string; bad: boolean };
}

export type EventKind = keyof Events;
export type EventOf<K extends EventKind> = { is: K } & Events[K];
export type Event = { [K in EventKind]: EventOf<K> }[EventKind];
export type Pins = Events["pins"];

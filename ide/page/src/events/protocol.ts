// What the module of drawings is asked about blocks of IEC 61499 and what it answers;
// `ide/drawings` defines it.
import type { Frame, Point } from "../page/ground";

export interface Boxed {
  text: string;
  frame: Frame;
}

export interface EventState {
  name: string;
  comment: string;
  isInitial: boolean;
  frame: Frame;
  /** The algorithm is executed before the event is sent. */
  actions: { algorithm: Boxed | null; output: Boxed | null }[];
}

export interface EventTransition {
  /** The numbers of the states that it leaves and enters. */
  states: [number, number];
  /** Its condition, with its place in the order. */
  text: string;
  label: Frame;
  /** Beginning, two control points, end. */
  curve: [Point, Point, Point, Point];
  middle: Point;
  arrow: [Point, Point, Point];
}

export interface BlockEvent {
  name: string;
  comment: string;
  /** The variables that it has with it. */
  with: string[];
}

export interface BlockValue {
  name: string;
  type: string;
  comment: string;
  /** Its value is a list. */
  isArray: boolean;
  value: string;
}

/** A block after all that was done with it. */
export interface Events {
  width: number;
  height: number;
  name: string;
  title: Point;
  states: EventState[];
  transitions: EventTransition[];
  /** The number of the state that it is in. */
  state: number;
  /** The transitions that the last event has cleared, in order, and the events that it has sent. */
  cleared: number[];
  sent: number[];
  eventInputs: BlockEvent[];
  eventOutputs: BlockEvent[];
  inputs: BlockValue[];
  outputs: BlockValue[];
  internals: BlockValue[];
  /** What each line came to. */
  told: { text: string; isWrong: boolean }[];
  /** What is wrong in the text; then there is nothing else. */
  mistake: { line: number; message: string } | null;
}

export interface Questions {
  /** `lines`: what was done with it, as `uno200 events` takes it. */
  events: { wish: { text: string; name: string; lines: string[] }; answer: Events };
}

// What the module of drawings is asked about diagrams and what it answers; `ide/drawings` defines it.
import type { Frame, Point } from "../page/ground";

/** An input or output of an element as it is drawn. */
export interface Pin {
  name: string;
  type: string;
  /** Where links end. */
  at: Point;
  /** What is given to it or where it goes, as drawn; empty where a link alone says it. */
  text: string;
  /** That in full, as written. */
  written: string | null;
  /** What its value may be called in the program: the first one that there is. Of an input that a
   * variable gives its value that variable. */
  names: string[];
}

/** An input that has its value from a declaration. */
export interface Parameter {
  name: string;
  type: string;
  /** As declared, with the instance or in the block; null where it begins as zero. */
  value: string | null;
  comment: string;
  names: string[];
}

/** A call of a block, or an assignment. */
export interface DiagramElement {
  id: string;
  line: number;
  /** Where in its line its name begins, in characters from 1. */
  column: number;
  /** As drawn, and whole. */
  name: string;
  fullName: string;
  /** Null of an assignment. */
  block: string | null;
  /** Its pins are those of the text. */
  isUnknown: boolean;
  comment: string;
  /** In which place it is executed, from 1. */
  order: number;
  frame: Frame;
  /** With the texts beside it. */
  room: Frame;
  inputs: Pin[];
  outputs: Pin[];
  parameters: Parameter[];
}

/** The numbers of an element and of a pin there. */
export type End = [element: number, pin: number];

export interface DiagramLink {
  from: End;
  to: End;
  /** The value of the scan before is taken. */
  isFeedback: boolean;
  points: Point[];
}

export interface DiagramSheet {
  name: string;
  title: Point;
  frame: Frame;
  elements: DiagramElement[];
  links: DiagramLink[];
  junctions: Point[];
  /** With the numbers of their elements. */
  groups: { name: string; frame: Frame; elements: number[] }[];
}

export interface Diagrams {
  width: number;
  height: number;
  sheets: DiagramSheet[];
  /** Why they cannot be drawn; then there are no sheets. */
  obstacle: string | null;
  /** What is wrong in the text; what could be read is drawn all the same. */
  mistake: { line: number; message: string } | null;
}

/** A change of a diagram. */
export type DiagramEdit =
  | { move: { elements: string[]; by: Point } }
  | { call: { block: string; at: Point } }
  | { write: { statement: string; at: Point } }
  | { give: { element: string; input: string; value: string } }
  | { set: { element: string; parameter: string; value: string } }
  | { group: { elements: string[]; name: string } }
  | { comment: { element: string; comment: string } }
  | { paste: { text: string; by: Point } }
  | { remove: { elements: string[] } };

/** A block that a diagram can have. */
export interface Block {
  name: string;
  origin: "project" | "library" | "standard";
  /** What it is, in a line; may be empty. */
  summary: string;
  inputs: string[];
  outputs: string[];
}

/** What is asked about; `others`: the other texts of the project in Structured Text. */
export interface Wish {
  text: string;
  name: string;
  others: string[];
}

export interface Questions {
  diagrams: { wish: Wish; answer: Diagrams };
  /** `new`: the elements that are new. */
  editDiagram: {
    wish: Wish & { diagram: number; edit: DiagramEdit };
    answer: { text: string; diagrams: Diagrams; new: string[] };
  };
  /** The text of elements, which can be pasted. */
  copyDiagram: { wish: Wish & { diagram: number; elements: string[] }; answer: string };
  blocks: { wish: Wish; answer: Block[] };
}

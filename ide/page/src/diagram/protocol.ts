// What the module of diagrams is asked and what it answers; `ide/diagrams` defines it. Each question
// has the text as it is in the editor: the text is the file, and nothing else is kept of a diagram.

/** Identifies an element in a sheet: its name in upper case (the instance that is called, or what is
 * assigned to), with `#2` and so on after it where a text has the name more often. */
export type ElementId = string;
export type At = [x: number, y: number];
export type Frame = [x: number, y: number, width: number, height: number];

/** A kind of block: of the library, of IEC 61131-3, of the project. The core answers them. */
export interface Block {
  name: string;
  /** `library`, `standard`, `project`. */
  origin: "library" | "standard" | "project";
  /** Where it is in the palette: `controllers`, `linear`, ...; empty for those of the project. */
  group: string;
  /** Functions are called in expressions, and are elements as assignments. */
  isFunction: boolean;
  summary: string;
  inputs: Variable[];
  outputs: Variable[];
}
export interface Variable {
  name: string;
  type: string;
  /** As written; null if it has none: it is to be connected then. */
  initial: string | null;
  comment: string;
  /** VAR_IN_OUT. */
  isInOut: boolean;
}

/** An input or output of an element as it is drawn. */
export interface Pin {
  name: string;
  type: string;
  /** Where links end. */
  at: At;
  /** What is given to an input (as drawn: one that is too long ends in dots), or what is beside an
   * output (`=> Lamp`); empty where a link alone says it. */
  text: string;
  /** Whole, as written; null if nothing is given. */
  written: string | null;
  /** What its value may be called in the program, the first one that there is; of an input that is
   * given an expression, the input of the instance. */
  names: string[];
}
/** An input that has a value of its own and is not connected: in the declaration of the instance, or
 * the one of its block. */
export interface Parameter {
  name: string;
  type: string;
  /** As written in the declaration of the instance; null if it has that of its block. */
  value: string | null;
  initial: string | null;
  comment: string;
  names: string[];
}
export interface DiagramElement {
  id: ElementId;
  line: number;
  /** As drawn, and whole. */
  name: string;
  fullName: string;
  /** Its block; null for an assignment. */
  type: string | null;
  /** Whether its block is not known: its pins are those of the text. */
  isUnknown: boolean;
  comment: string;
  /** In which place it is executed, from 1. */
  order: number;
  frame: Frame;
  inputs: Pin[];
  outputs: Pin[];
  parameters: Parameter[];
}
export interface End {
  element: ElementId;
  pin: string;
}
export interface DiagramLink {
  from: End;
  to: End;
  /** Whether the value of the scan before is taken. */
  isFeedback: boolean;
  points: At[];
  names: string[];
}
export interface DiagramGroup {
  name: string;
  frame: Frame;
  elements: ElementId[];
}
export interface DiagramSheet {
  name: string;
  title: At;
  frame: Frame;
  /** Whether the text gives places; otherwise the layout is automatic. */
  isPlaced: boolean;
  /** Where the place (0, 0) of its text is in the drawing: a place is a point of the drawing minus this. */
  origin: At;
  elements: DiagramElement[];
  links: DiagramLink[];
  groups: DiagramGroup[];
}
export interface Diagrams {
  width: number;
  height: number;
  sheets: DiagramSheet[];
  /** Why it cannot be drawn; then there are no sheets. */
  obstacle: string | null;
  /** Why it cannot be edited (the text has a mistake: its line, from 1); null if it can. What only
   * breaks rules of diagrams (a loop, two sources) can be edited. */
  mistake: { line: number; message: string } | null;
}

/** An edit: one of these. What is not allowed is refused with its reason. */
export type Edit =
  /** A call of a block with a new instance; its name follows from the block where none is given. In a
   * text without a diagram it makes the PROGRAM around it, too. */
  | { addBlock: { type: string; name: string | null; at: At | null } }
  /** An assignment, `Lamp := Button`; with a type its target is declared. */
  | { addAssignment: { target: string; type: string | null; value: string; at: At | null } }
  /** Gives an output to an input. */
  | { connect: { from: End; to: End; isFeedback: boolean } }
  /** Makes a link one of the scan before, or of this scan. */
  | { setFeedback: { from: End; to: End; isFeedback: boolean } }
  /** What an input is given: any expression; null takes it out. */
  | { setInput: { element: ElementId; pin: string; text: string | null } }
  /** Where an output goes, `=> Lamp`; null takes it out. */
  | { setOutput: { element: ElementId; pin: string; text: string | null } }
  /** The value in the declaration of the instance; null is that of the block. */
  | { setParameter: { element: ElementId; parameter: string; value: string | null } }
  /** An instance with all that is connected to it, or a variable that is assigned to. */
  | { rename: { element: ElementId; name: string } }
  /** Elements with their declarations, and links to them. */
  | { erase: { elements: ElementId[] } }
  | { eraseLink: { from: End; to: End } }
  /** Places as they are in the drawing, without its origin. */
  | { place: { elements: [ElementId, At][] } }
  | { layout: Record<string, never> }
  /** What `copy` has answered. */
  | { paste: { text: string; at: At | null } }
  | { comment: { of: ElementId; text: string } }
  /** A frame with a name around elements; an element is in one at most. */
  | { group: { elements: ElementId[]; name: string } }
  | { ungroup: { elements: ElementId[] } };

/** A question has the text, what the program is called that is not there yet, and the blocks that
 * there are. */
interface Text {
  text: string;
  name: string;
}

export interface Questions {
  /** The blocks of the project; kept until the next ones. */
  blocks: { wish: { blocks: Block[] }; answer: null };
  draw: { wish: Text; answer: Diagrams };
  /** All of the edits, or none; which elements are to be selected then. */
  edit: {
    wish: Text & { sheet: number; edits: Edit[] };
    answer: { text: string; diagrams: Diagrams; select: ElementId[] };
  };
  /** For each edit why it would be refused, or null. */
  allowed: { wish: Text & { sheet: number; edits: Edit[] }; answer: (string | null)[] };
  copy: { wish: Text & { sheet: number; elements: ElementId[] }; answer: string };
}

// What the module of charts is asked and what it answers; `ide/drawings` defines it. Each question has the
// text as it is in the editor: the text is the file, and nothing else is kept of a chart.

/** Identifies an element of a chart: `s` or `t` for a step or a transition, and its number. It stays the same over edits of
 * the module; a text that was changed by hand has new ones. */
export type ElementId = `s${number}` | `t${number}`;
export type At = [x: number, y: number];
export type Frame = [x: number, y: number, width: number, height: number];
type Line = [x: number, y: number, endX: number, endY: number];

export interface ChartAction {
  line: number;
  frame: Frame;
  divider: number | null;
  /** As drawn: qualifier with its time, and the action with its condition or event. */
  qualifier: string;
  name: string;
  /** To be edited: null for a forcing order of GRAFCET, which is edited in the text. */
  written: { qualifier: string; time: string | null; action: string } | null;
}
export interface ChartStep {
  id: ElementId;
  line: number;
  /** As drawn (one that is too long ends in dots), and whole. */
  name: string;
  fullName: string;
  note: string;
  comment: string;
  frame: Frame;
  isInitial: boolean;
  isLinked: boolean;
  look: "plain" | "macro" | "enclosing";
  actions: ChartAction[];
  /** The number of the sheet that a macro-step stands for. */
  expansion: number | null;
}
/** A variable in a condition: as written, what it may be called in the program, the first one that there is, and what
 * kind of value it has; a time is in milliseconds. */
export interface ChartOperand {
  written: string;
  names: string[];
  kind: "truth" | "number" | "time";
}
export interface ChartTransition {
  id: ElementId;
  line: number;
  title: string;
  name: string | null;
  priority: number | null;
  /** Whole, as written. */
  condition: string;
  operands: ChartOperand[];
  comment: string;
  from: ElementId[];
  to: ElementId[];
  bar: Line;
  text: string[];
  label: At;
  lines: At[][];
  doubles: Line[];
  arrows: At[];
}
export interface ChartSheet {
  name: string;
  title: At;
  frame: Frame;
  /** Whether it is folded: it has no elements then. */
  isFolded: boolean;
  isGrafcet: boolean;
  /** Whether the text gives places; otherwise the layout is automatic. */
  isPlaced: boolean;
  /** Where the place (0, 0) of its text is in the drawing: a place is a point of the drawing minus this. */
  origin: At;
  steps: ChartStep[];
  transitions: ChartTransition[];
}
export interface Charts {
  width: number;
  height: number;
  sheets: ChartSheet[];
  /** Why it cannot be drawn; then there are no sheets. */
  obstacle: string | null;
  /** Why it cannot be edited (the text has a mistake: its line, from 1); null if it can. */
  mistake: { line: number; message: string } | null;
}

/** What is wanted of a step's block. */
export interface Wanted {
  qualifier: string;
  time: string | null;
  action: string;
}

/** An edit: one of these. */
export type Edit =
  | { addStep: { at: At | null; isInitial: boolean } }
  | { addAfter: { of: ElementId } }
  | { addBefore: { of: ElementId } }
  | { addBranch: { of: ElementId; isParallel: boolean } }
  | { connect: { from: ElementId[]; to: ElementId[] } }
  | { erase: { elements: ElementId[] } }
  | { rename: { step: ElementId; name: string } }
  | { setInitial: { step: ElementId; isInitial: boolean } }
  | { setCondition: { transition: ElementId; text: string } }
  | {
      setTransition: {
        transition: ElementId;
        name: string | null;
        priority: number | null;
        from: ElementId[];
        to: ElementId[];
      };
    }
  | { setAction: { step: ElementId; index: number; action: Wanted } }
  | { insertAction: { step: ElementId; index: number; action: Wanted } }
  | { removeAction: { step: ElementId; index: number } }
  | { clearActions: { step: ElementId } }
  | { moveAction: { step: ElementId; index: number; to: number } }
  | { place: { elements: [ElementId, At][] } }
  | { layout: {} }
  | { paste: { text: string; at: At | null } }
  | { comment: { of: ElementId; text: string } };

/** A transition with a value for each operand of its condition. */
export interface Judged {
  chart: number;
  transition: ElementId;
  values: (number | null)[];
}
/** Whether a condition is TRUE, null where that is not known, and what is missing if it is FALSE. */
export interface Judgement {
  isTrue: boolean | null;
  waitsFor: string;
}

export type ConvertTarget = "uno200" | "twincat" | "pl7" | "plcopen";
/** A variable of charts of SFCEdit: as the table says, or as its use suggests. */
export interface ConvertedVariable {
  name: string;
  kind: string;
  type: string;
  value: string | null;
}
/** What becomes of charts of SFCEdit; no program if something is wrong. */
export interface Converted {
  variables: ConvertedVariable[];
  problems: {
    line: number;
    isOfTable: boolean;
    isError: boolean;
    message: string;
    help: string[];
  }[];
  program: string | null;
  ending: string;
  equations: string;
}

/** Questions with what is asked and answered. `name` is what a chart is called that is not there yet (the file's name
 * without its end, made a name), `chart` the number of a sheet. Answers to questions that are refused are
 * `{ refused: string }`. */
export interface Questions {
  /** `folded`: the names of sheets that are left out. */
  draw: { wish: { text: string; name: string; folded: string[] }; answer: Charts };
  /** All of the edits, or none. */
  edit: {
    wish: { text: string; name: string; folded: string[]; chart: number; edits: Edit[] };
    answer: { text: string; charts: Charts; select: ElementId[] };
  };
  /** Which of these edits would be refused, and why; null for the others. Changes nothing. */
  allowed: {
    wish: { text: string; name: string; chart: number; edits: Edit[] };
    answer: (string | null)[];
  };
  /** Whether conditions are TRUE with values. */
  judge: {
    wish: { text: string; name: string; transitions: Judged[] };
    answer: Judgement[];
  };
  /** Charts of SFCEdit for a target, with a table of variables as a file has it. */
  convert: {
    wish: { text: string; name: string; variables: string; target: ConvertTarget };
    answer: Converted;
  };
  copy: { wish: { text: string; name: string; chart: number; steps: ElementId[] }; answer: string };
}

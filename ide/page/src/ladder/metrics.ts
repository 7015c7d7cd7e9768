// Sizes of a ladder in units of its drawing: a cell holds a contact with its operands.
export const CELL = { width: 112, height: 88 };
/** The power rail is left of the first column, and something is free right of the last one. */
export const RAIL_AT = 10;
const RIGHT = 14;
/** Where in a cell power flows. */
export const FLOW_AT = 44;
/** From one operand beside a box to the next; as many as fit into a row, the core knows. */
export const PIN_PITCH = 21;
/** Characters that fit into a cell. */
export const CHARACTERS = 14;

export const x = (column: number): number => RAIL_AT + column * CELL.width;
export const y = (row: number): number => row * CELL.height + FLOW_AT;
export const width = (columns: number): number => x(columns) + RIGHT;
export const height = (rows: number): number => rows * CELL.height;

/** A text that is too long ends in dots. */
export function fit(text: string, characters = CHARACTERS): string {
  return text.length <= characters ? text : `${text.slice(0, Math.max(1, characters - 1))}…`;
}

// Contacts, coils and boxes as pictures. A picture tells where values are written, and shows them.
import type { LadderElement, LadderPin, Value } from "../core/protocol";
import { s } from "../page/dom";
import { CELL, CHARACTERS, fit, PIN_PITCH, x, y } from "./metrics";

/** Half the width of a symbol between bars or brackets. */
const half = (symbol: string) => Math.max(10, symbol.length * 4 + 6);

interface Written {
  pin: LadderPin;
  element: SVGTextElement;
  name: SVGTSpanElement;
  value: SVGTSpanElement;
  characters: number;
}

/** An element that is drawn. */
export class Shape {
  /** All of it. */
  readonly group: SVGGElement;
  /** What has the focus and the name. */
  readonly button: SVGGElement;
  private picture: SVGGElement;
  private before: [SVGElement, number][] = [];
  private after: SVGElement[] = [];
  private written: Written[] = [];

  constructor(readonly element: LadderElement) {
    const { column, row, columns, rows } = element;
    const frame = s("rect", {
      x: x(column) + 3,
      y: row * CELL.height + 2,
      width: columns * CELL.width - 6,
      height: rows * CELL.height - 4,
      rx: 6,
      class: "frame",
    });
    const line = [element.mnemonic, element.pins.map(({ text }) => text).join(", ")].join(" ");
    // Its name says all that is written around it.
    this.button = s("g", { role: "button", tabindex: -1 }, frame);
    const picture = s("g", { "aria-hidden": "true" }, s("title", {}, line));
    this.group = s("g", { class: `element ${element.shape}` }, this.button, picture);
    this.picture = picture;
    if (element.shape === "box") this.box();
    else this.symbol();
  }

  /** A contact or coil. */
  private symbol(): void {
    const { element, picture } = this;
    const middle = x(element.column) + CELL.width / 2;
    const flow = y(element.row);
    const wide = half(element.symbol);
    this.lead(x(element.column), middle - wide, flow, element.powers[0]?.[2] ?? 0);
    if (element.shape === "contact") {
      picture.append(
        s("path", {
          d: `M${middle - wide} ${flow - 12}v24M${middle + wide} ${flow - 12}v24`,
          class: "bars",
        }),
      );
      this.after.push(this.line(middle + wide, x(element.column + 1), flow));
    } else {
      const arc = (side: 1 | -1) =>
        `M${middle + side * (wide - 5)} ${flow - 13}q${side * 10} 13 0 26`;
      picture.append(s("path", { d: arc(-1) + arc(1), class: "bars" }));
    }
    if (element.symbol === "/")
      picture.append(s("path", { d: `M${middle - 7} ${flow + 11}l14 -22`, class: "bars" }));
    else if (element.symbol)
      picture.append(
        s("text", { x: middle, y: flow + 4.5, "text-anchor": "middle" }, element.symbol),
      );
    for (const pin of element.pins) {
      const isAbove = pin.side === "above";
      const first = isAbove ? flow - 30 : flow + 25;
      this.two(pin, middle, first, first + 13);
    }
  }

  private box(): void {
    const { element, picture } = this;
    const { column, row, rows, powers, pins } = element;
    const left = x(column + 1);
    const right = left + CELL.width;
    const above = pins.find((pin) => pin.side === "above");
    const top = row * CELL.height + (above ? 18 : 6);
    const last = powers.at(-1)?.[1] ?? 0;
    const beside = (side: string) => pins.filter((pin) => pin.side === side);
    picture.append(
      s("rect", {
        x: left,
        y: top,
        width: CELL.width,
        height: (row + rows) * CELL.height - 7 - top,
        class: "body",
      }),
      s(
        "text",
        { x: left + CELL.width / 2, y: top + 16, "text-anchor": "middle", class: "title" },
        fit(element.symbol),
      ),
    );
    if (above) this.one(above, left + CELL.width / 2, top - 5, "middle", CHARACTERS + 8);
    for (const [name, at, net] of powers) {
      this.lead(x(column), left, y(row + at), net);
      picture.append(s("text", { x: left + 6, y: y(row + at) + 4 }, name));
    }
    for (const [index, pin] of beside("left").entries())
      this.pin(pin, left, y(row + last) + (index + 1) * PIN_PITCH, -1);
    for (const [index, pin] of beside("right").entries())
      this.pin(pin, right, y(row) + (index + 1) * PIN_PITCH, 1);
    if (element.output === null) return;
    picture.append(s("text", { x: right - 6, y: y(row) + 4, "text-anchor": "end" }, "ENO"));
    this.after.push(this.line(right, x(column + element.columns), y(row)));
  }

  /** An operand beside a box: -1 left, 1 right. */
  private pin(pin: LadderPin, edge: number, at: number, side: 1 | -1): void {
    const anchor = side < 0 ? "end" : "start";
    const inside = side < 0 ? "start" : "end";
    this.picture.append(
      s("path", { d: `M${edge} ${at}h${side * 7}`, class: "bars" }),
      s("text", { x: edge - side * 6, y: at + 4, "text-anchor": inside }, fit(pin.name, 8)),
    );
    this.one(pin, edge + side * 11, at + 4, anchor, CHARACTERS - 1);
  }

  private line(from: number, to: number, at: number): SVGElement {
    const line = s("path", { d: `M${from} ${at}H${to}`, class: "wire" });
    this.picture.append(line);
    return line;
  }

  private lead(from: number, to: number, at: number, net: number): void {
    this.before.push([this.line(from, to, at), net]);
  }

  /** An operand with its value behind it. */
  private one(pin: LadderPin, at: number, line: number, anchor: string, characters: number): void {
    const name = s("tspan", {}, fit(pin.text, characters));
    const value = s("tspan", { class: "live-value" });
    const element = s(
      "text",
      { x: at, y: line, "text-anchor": anchor, class: "operand" },
      name,
      value,
    );
    this.written.push({ pin, element, name, value, characters });
    element.prepend(s("title", {}, title(pin)));
    this.picture.append(element);
  }

  /** An operand in two lines: its value is in place of its other name. */
  private two(pin: LadderPin, at: number, first: number, second: number): void {
    const name = s("tspan", { x: at, y: first }, fit(pin.text));
    const value = s("tspan", { x: at, y: second, class: "other" }, fit(pin.other ?? ""));
    const element = s("text", { "text-anchor": "middle", class: "operand" }, name, value);
    this.written.push({ pin, element, name, value, characters: 0 });
    element.prepend(s("title", {}, title(pin)));
    this.picture.append(element);
  }

  /** The operand that is written where this is. */
  pinAt(target: Element): LadderPin | undefined {
    return this.written.find(({ element }) => element.contains(target))?.pin;
  }

  /** Power flow and values. */
  show(nets: (boolean | null)[], state: boolean | null, values: Value[]): void {
    for (const [line, net] of this.before) colour(line, nets[net] ?? null);
    const { output } = this.element;
    for (const line of this.after) colour(line, output === null ? null : (nets[output] ?? null));
    colour(this.group, state);
    for (const { pin, element, name, value, characters } of this.written) {
      const known = values.filter((value) => value.name === pin.text);
      const isBit = characters === 0 && known.some((value) => value.form === "bit");
      const number = known.find((value) => !isBit && value.form !== "bit" && value.text !== "");
      element.classList.toggle(
        "forced",
        known.some((value) => value.forced),
      );
      const text = number ? number.text : "";
      if (characters > 0) {
        put(name, fit(pin.text, characters - (text ? text.length + 1 : 0)));
        put(value, text && ` ${text}`);
      } else {
        put(value, fit(text || (pin.other ?? "")));
        value.setAttribute("class", text ? "live-value" : "other");
      }
    }
  }
}

function title(pin: LadderPin): string {
  return [pin.text, pin.other, pin.comment].filter(Boolean).join(" – ");
}

function put(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

/** Power flow as a class; neither where it is not known. */
export function colour(element: Element, flow: boolean | null): void {
  element.classList.toggle("on", flow === true);
  element.classList.toggle("off", flow === false);
}

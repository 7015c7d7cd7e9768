// Makes elements. Texts that a person reads come from the language table; they change when the
// language does.
import { onLanguage, t, type Args, type Key } from "../text/language";

export type Child = Node | string | null | undefined | false;

interface Options<E extends Element> {
  class?: string;
  /** The text, the accessible name and the explanation, from the table. */
  text?: Key;
  label?: Key;
  title?: Key;
  placeholder?: Key;
  attributes?: Record<string, string | number | boolean | undefined>;
  on?: { [K in keyof HTMLElementEventMap]?: (event: HTMLElementEventMap[K]) => void };
  /** Properties, such as `value`. */
  set?: Partial<E>;
}

type Where = "text" | "aria-label" | "title" | "placeholder";
type Said = Map<Where, { key: Key; args: Args }>;
/** What elements say, so that it can be said again in another language. */
const said = new WeakMap<Element, Said>();
const MARK = "data-said";

/** An HTML element. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  options: Options<HTMLElementTagNameMap[K]> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  if (options.class) element.className = options.class;
  setAttributes(element, options.attributes ?? {});
  for (const [event, listener] of Object.entries(options.on ?? {}))
    element.addEventListener(event, listener as EventListener);
  if (options.text) say(element, "text", options.text);
  if (options.label) say(element, "aria-label", options.label);
  if (options.title) say(element, "title", options.title);
  if (options.placeholder) say(element, "placeholder", options.placeholder);
  append(element, children);
  Object.assign(element, options.set ?? {});
  return element;
}

/** An SVG element. */
export function s<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Record<string, string | number | boolean | undefined> = {},
  ...children: Child[]
): SVGElementTagNameMap[K] {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  setAttributes(element, attributes);
  append(element, children);
  return element;
}

/** Sets attributes; `undefined` and `false` are left out. */
export function setAttributes(element: Element, attributes: Record<string, unknown>): void {
  for (const [name, value] of Object.entries(attributes))
    if (value !== undefined && value !== false)
      element.setAttribute(name, value === true ? "" : String(value));
}

function append(element: Element, children: Child[]): void {
  element.append(...children.filter((child): child is Node | string => !!child));
}

/** Says something from the table at an element, and again when the language changes. */
export function say(element: Element, where: Where, key: Key, ...args: Args): void {
  const known: Said = said.get(element) ?? new Map();
  known.set(where, { key, args });
  said.set(element, known);
  element.setAttribute(MARK, "");
  write(element, where, t(key, ...args));
}

function write(element: Element, where: Where, text: string): void {
  if (where === "text") element.textContent = text;
  else element.setAttribute(where, text);
}

onLanguage(() => {
  for (const element of document.querySelectorAll(`[${MARK}]`))
    for (const [where, { key, args }] of said.get(element) ?? [])
      write(element, where, t(key, ...args));
});

let lastId = 0;

/** A name for an element that others refer to. */
export function newId(): string {
  lastId += 1;
  return `n${lastId}`;
}

/** A select with options whose words come from the table, or stand for themselves. */
export function select<V extends string>(
  label: Key,
  options: readonly (readonly [V, Key | { plain: string }])[],
  value: V,
  changed: (value: V) => void,
): HTMLSelectElement {
  const element = h("select", { label, title: label });
  for (const [value, text] of options) {
    const option = h("option", { set: { value } });
    if (typeof text === "string") say(option, "text", text);
    else option.textContent = text.plain;
    element.append(option);
  }
  element.value = value;
  element.addEventListener("change", () => changed(element.value as V));
  return element;
}

/** A button with words, and perhaps a picture before them. */
export function button(
  text: Key,
  clicked: (event: MouseEvent) => void,
  options: { icon?: SVGElement; class?: string; title?: Key } = {},
): HTMLButtonElement {
  const words = h("span", { text, class: "words" });
  const element = h(
    "button",
    {
      class: options.class ?? "",
      attributes: { type: "button" },
      on: { click: clicked },
      title: options.title ?? text,
    },
    options.icon,
    words,
  );
  return element;
}

/** A button that is a picture alone. */
export function iconButton(
  icon: SVGElement,
  label: Key,
  clicked: (event: MouseEvent) => void,
  ...args: Args
): HTMLButtonElement {
  const element = h(
    "button",
    { class: "icon", attributes: { type: "button" }, on: { click: clicked } },
    icon,
  );
  say(element, "aria-label", label, ...args);
  say(element, "title", label, ...args);
  return element;
}

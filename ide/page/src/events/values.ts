// A table of variables of a block; the values of inputs can be set there.
import { h } from "../page/dom";
import { field } from "../page/field";
import type { Key } from "../text/language";
import type { BlockValue } from "./protocol";

/** Gives a variable another value, and tells whether that could be done. */
type Set = (one: BlockValue, text: string) => Promise<boolean>;

export function valuesTable(title: Key, values: BlockValue[], set?: Set): HTMLElement {
  const head = h("th", { text: title, attributes: { scope: "col", colspan: 3 } });
  const rows = h("tbody", {}, ...values.map((one) => row(one, set)));
  const table = h("table", {}, h("thead", {}, h("tr", {}, head)), rows);
  table.hidden = values.length === 0;
  return table;
}

function row(one: BlockValue, set?: Set): HTMLElement {
  const { name, type, comment, value } = one;
  const shown = set ? control(one, set) : h("code", {}, value);
  return h(
    "tr",
    {},
    h("th", { attributes: { scope: "row", title: comment || undefined } }, name),
    h("td", { class: "type" }, type),
    h("td", {}, shown),
  );
}

function control(one: BlockValue, set: Set): HTMLElement {
  const { name, type, isArray, value } = one;
  if (type !== "BOOL" || isArray)
    return field(name, value, (text) => set(one, text), { "aria-label": name });
  const options = ["FALSE", "TRUE"].map((text) => h("option", {}, text));
  const attributes = { "aria-label": name, "data-of": name };
  const select = h("select", { attributes }, ...options);
  select.value = value;
  select.addEventListener("change", () => void set(one, select.value));
  return select;
}

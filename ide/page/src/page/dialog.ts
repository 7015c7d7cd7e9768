// Dialogs: something to read, to confirm, or to write.
import { button, h, newId } from "./dom";
import { t, type Args, type Key } from "../text/language";

interface Parts {
  title: string;
  body: Node[];
  /** The button that agrees; without it there is only one that closes. */
  agree?: Key;
}

/** Shows a dialog; true where it was agreed to. */
export function dialog({ title, body, agree }: Parts): Promise<boolean> {
  const heading = h("h2", { attributes: { id: newId() } }, title);
  const form = h("form", { attributes: { method: "dialog" } });
  const element = h("dialog", { attributes: { "aria-labelledby": heading.id } }, form);
  const cancel = button(agree ? "cancel" : "close", () => element.close(""));
  const ok = agree && h("button", { class: "primary", text: agree, set: { value: "yes" } });
  form.append(
    heading,
    h("div", { class: "body", attributes: { tabindex: agree ? undefined : 0 } }, ...body),
    h("div", { class: "buttons" }, cancel, ok),
  );
  document.body.append(element);
  element.showModal();
  return new Promise((resolve) => {
    element.addEventListener("close", () => {
      element.remove();
      resolve(element.returnValue === "yes");
    });
  });
}

/** Asks whether something shall be done. */
export function confirm(title: Key, question: Key, agree: Key, ...args: Args): Promise<boolean> {
  return dialog({ title: t(title), body: [h("p", {}, t(question, ...args))], agree });
}

/** Asks for a line of text; null where nobody gave one. It may be empty where it is not `required`. */
export async function ask(
  title: string,
  label: Key,
  value: string,
  agree: Key,
  required = true,
): Promise<string | null> {
  const id = newId();
  const input = h("input", {
    attributes: { id, required, autocomplete: "off", spellcheck: "false" },
    set: { value },
  });
  const words = h("label", { text: label, attributes: { for: id } });
  const answer = dialog({ title, body: [words, input], agree });
  const dot = value.lastIndexOf(".");
  input.focus();
  input.setSelectionRange(0, dot > 0 ? dot : value.length);
  return (await answer) ? input.value.trim() : null;
}

/** One of several that can be chosen. */
interface Entry<T> {
  text: string;
  hint?: string;
  value: T;
  /** Takes it out of the list for good. */
  forget?: () => void;
}

/** Lets one of several be chosen; null for none. */
export async function pick<T>(title: string, entries: Entry<T>[]): Promise<T | null> {
  let picked: T | null = null;
  const list = h("ul", { class: "list" });
  for (const { text, hint, value, forget } of entries) {
    const take = (event: MouseEvent) => {
      picked = value;
      (event.currentTarget as Element).closest("dialog")?.close();
    };
    const item = h("li");
    const row = h("button", { class: "row", attributes: { type: "button" }, on: { click: take } });
    row.append(h("span", {}, text), h("span", { class: "where" }, hint ?? ""));
    item.append(row);
    if (forget)
      item.append(
        button("forget", () => {
          forget();
          item.remove();
        }),
      );
    list.append(item);
  }
  const body = entries.length > 0 ? list : h("p", { class: "nothing", text: "nothingKept" });
  await dialog({ title, body: [body] });
  return picked;
}

// A field with something of the text: a value, a comment. What is refused is not kept in it.
import { h } from "./dom";

/** `of`: what it is of, by which it is found again; `change`: whether that could be done. */
export function field(
  of: string,
  written: string,
  change: (value: string) => Promise<boolean>,
  attributes: Record<string, string> = {},
): HTMLInputElement {
  const input = h("input", {
    attributes: { autocomplete: "off", spellcheck: "false", ...attributes },
    set: { value: written },
  });
  input.dataset["of"] = of;
  input.addEventListener("keydown", (event) => {
    if (event.key === "Escape") input.value = written;
  });
  input.addEventListener("change", async () => {
    const value = input.value.trim();
    if (value === written) return;
    if (!(await change(value))) input.value = written;
  });
  return input;
}

// What the program has that can be watched: a list of suggestions for fields.
import type { Core } from "../core/core";
import { h, newId } from "../page/dom";
import type { Key } from "../text/language";

/** A list for `<input list>`, filled anew with each program. */
export class Operands {
  readonly element = h("datalist", { attributes: { id: newId() } });
  /** The names, symbols first. */
  names: string[] = [];

  constructor(core: Core) {
    core.on("program", ({ program }) => {
      // While there are errors the suggestions of before are better than none.
      if (program) this.fill(program.operands);
    });
  }

  /** A field for one or several of them, with suggestions; `words` name it where no label does. */
  field(words?: Key, isRequired = true): HTMLInputElement {
    return h("input", {
      ...(words ? { label: words, placeholder: words } : {}),
      attributes: {
        list: this.element.id,
        autocomplete: "off",
        spellcheck: "false",
        required: isRequired,
      },
    });
  }

  private fill(operands: [string, string][]): void {
    this.names = operands.map(([name]) => name);
    this.element.replaceChildren(
      ...operands.map(([name, meaning]) =>
        h("option", { set: { value: name }, attributes: { label: meaning || undefined } }),
      ),
    );
  }
}

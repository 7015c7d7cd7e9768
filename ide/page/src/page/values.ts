// Setting, forcing and releasing values, from wherever one is shown.
import type { Core } from "../core/core";
import type { Value } from "../core/protocol";
import { t } from "../text/language";
import { ask } from "./dialog";
import { openMenu, type MenuItem } from "./menu";

/** Asks for a value and does something with it. */
async function withValue(value: Value, title: string, act: (text: string) => void): Promise<void> {
  const text = await ask(title, "newValue", value.text, "apply");
  if (text !== null) act(text);
}

/** The menu of a value. */
export function valueMenu(core: Core, value: Value, at: Element): void {
  const operand = value.name;
  const set = (value: string) => core.tell({ do: "set", operand, value });
  const force = (value: string) => core.tell({ do: "force", operand, value });
  const isBit = value.form === "bit";
  const sets: MenuItem[] = isBit
    ? ["0", "1"].map((bit) => ({ text: t("setTo", operand, bit), act: () => set(bit) }))
    : [{ text: t("setAsk", operand), act: () => void withValue(value, t("setAsk", operand), set) }];
  const forces: MenuItem[] = isBit
    ? ["0", "1"].map((bit) => ({ text: t("forceTo", operand, bit), act: () => force(bit) }))
    : [
        {
          text: t("forceAsk", operand),
          act: () => void withValue(value, t("forceAsk", operand), force),
        },
      ];
  const release: MenuItem = {
    text: t("release", operand),
    act: () => core.tell({ do: "unforce", operand }),
    disabled: !value.forced,
  };
  openMenu(at, [sets, value.canForce ? [...forces, release] : []]);
}

/** The menu of a line: of its value, or a choice of several. */
export function valuesMenu(core: Core, values: Value[], at: Element): void {
  const [only] = values;
  if (only && values.length === 1) return valueMenu(core, only, at);
  const text = (value: Value) => `${value.name} = ${value.text}`;
  const items = values.map((value) => ({
    text: text(value),
    act: () => valueMenu(core, value, at),
  }));
  openMenu(at, [items]);
}

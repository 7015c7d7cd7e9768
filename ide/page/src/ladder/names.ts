// What elements of a ladder are called for those who do not see them.
import type { LadderElement } from "../core/protocol";
import { t } from "../text/language";

/** `Start I0.0` */
function operands({ pins }: LadderElement): string {
  const text = ({ name, text, other }: LadderElement["pins"][number]) =>
    [name && `${name} =`, text, other].filter(Boolean).join(" ");
  return pins.map(text).join(", ");
}

/** `contact Start I0.0, closed` */
export function nameOf(element: LadderElement, state: boolean | null): string {
  const { shape, symbol } = element;
  const what = [symbol.replace("/", ""), operands(element)].filter(Boolean).join(" ");
  const name =
    shape === "box"
      ? t("ladderBox", what)
      : shape === "coil"
        ? t("ladderCoil", what)
        : t(symbol.includes("/") ? "ladderInverted" : "ladderContact", what);
  if (state === null) return name;
  const words = element.isSwitch
    ? t(state ? "ladderClosed" : "ladderOpen")
    : t(state ? "ladderPower" : "ladderNoPower");
  return `${name}, ${words}`;
}

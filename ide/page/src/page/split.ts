// A line between two parts of the page that moves them, by pointer and by arrow keys.
import { h } from "./dom";
import type { Key } from "../text/language";
import { store, storedText } from "../project/stored";

interface Split {
  label: Key;
  /** The property of the style sheet that has the size, without its dashes. */
  property: string;
  /** Whether the line moves to the left and right. */
  isColumn: boolean;
  /** Whether the part that is sized is after the line. */
  isAfter: boolean;
  min: number;
}

const STEP = 24;

/** The line. */
export function separator({ label, property, isColumn, isAfter, min }: Split): HTMLElement {
  const stored = `uno200.${property}`;
  const root = document.documentElement;
  const direction = isAfter ? -1 : 1;
  const total = () => (isColumn ? innerWidth : innerHeight);
  let size = Number(storedText(stored)) || 0;

  const line = h("div", {
    class: isColumn ? "split column" : "split row",
    label,
    attributes: {
      role: "separator",
      tabindex: 0,
      "aria-orientation": isColumn ? "vertical" : "horizontal",
      "aria-valuemin": min,
      "aria-valuenow": size || min,
    },
  });
  const current = () => {
    const part = isAfter ? line.nextElementSibling : line.previousElementSibling;
    const box = part?.getBoundingClientRect();
    return (isColumn ? box?.width : box?.height) ?? min;
  };
  const set = (wanted: number) => {
    size = Math.round(Math.max(min, Math.min(wanted, total() * 0.7)));
    root.style.setProperty(`--${property}`, `${size}px`);
    line.setAttribute("aria-valuenow", String(size));
    store(stored, String(size));
  };
  if (size > 0) set(size);

  line.addEventListener("pointerdown", (down) => {
    const start = current();
    const from = isColumn ? down.clientX : down.clientY;
    line.setPointerCapture(down.pointerId);
    line.onpointermove = (move) => {
      const now = isColumn ? move.clientX : move.clientY;
      set(start + direction * (now - from));
    };
  });
  const end = () => (line.onpointermove = null);
  line.addEventListener("pointerup", end);
  line.addEventListener("pointercancel", end);
  line.addEventListener("keydown", (event) => {
    const keys = isColumn ? ["ArrowLeft", "ArrowRight"] : ["ArrowUp", "ArrowDown"];
    const at = keys.indexOf(event.key);
    if (at < 0) return;
    event.preventDefault();
    set(current() + direction * (at === 0 ? -STEP : STEP));
  });
  return line;
}

// What can be set in a plant: buttons, switches, sliders; and faults, which are switches in a group
// of their own.
import type { Core } from "../core/core";
import type { Control } from "../core/protocol";
import { h, newId, say } from "../page/dom";
import { inLanguage, type Key } from "../text/language";
import { hold } from "./hold";

export class Controls {
  readonly element = h("div", { class: "handles" });
  private labels: { element: HTMLElement; control: Control }[] = [];

  constructor(private core: Core) {}

  /** Other ones, as they are when a plant begins. */
  show(controls: Control[]): void {
    this.labels = [];
    const isFault = ({ kind }: Control) => kind === "fault";
    this.element.replaceChildren(
      ...this.group(
        "operatePlant",
        controls.filter((control) => !isFault(control)),
      ),
      ...this.group("faultsOfPlant", controls.filter(isFault)),
    );
    this.relabel();
  }

  /** Says everything again, in the language that is chosen. */
  relabel(): void {
    for (const { element, control } of this.labels) {
      const words = inLanguage(control.words);
      if (control.kind === "button") say(element, "text", "pressControl", words);
      else element.textContent = words;
    }
  }

  private group(title: Key, controls: Control[]): HTMLElement[] {
    if (controls.length === 0) return [];
    const heading = h("h2", { text: title, attributes: { id: newId() } });
    const attributes = { role: "group", "aria-labelledby": heading.id };
    const rows = controls.map((control) => this.row(control));
    return [h("div", { class: "handle-group", attributes }, heading, ...rows)];
  }

  private row(control: Control): HTMLElement {
    const label = h("span", { attributes: { id: newId() } });
    this.labels.push({ element: label, control });
    const row = h("div", { class: "handle" });
    if (control.kind === "button") row.append(this.button(control, label), label);
    else if (control.kind === "slider") row.append(label, ...this.slider(control, label));
    else row.append(this.toggle(control, label), label);
    return row;
  }

  private set({ name }: Control, value: number): void {
    this.core.tell({ do: "handle", name, value });
  }

  private button(control: Control, label: HTMLElement): HTMLElement {
    const attributes = { type: "button", "aria-labelledby": label.id };
    const push = h("button", { class: "push", attributes });
    hold(push, (isDown) => this.set(control, isDown ? 1 : 0));
    return push;
  }

  private toggle(control: Control, label: HTMLElement): HTMLElement {
    const isOn = () => toggle.getAttribute("aria-checked") === "true";
    const toggle = h("button", {
      class: control.kind === "fault" ? "switch of-fault" : "switch",
      attributes: {
        type: "button",
        role: "switch",
        "aria-checked": String(control.value === 1),
        "aria-labelledby": label.id,
      },
      on: {
        click: () => {
          toggle.setAttribute("aria-checked", String(!isOn()));
          this.set(control, isOn() ? 1 : 0);
        },
      },
    });
    // The words belong to it for a finger, too.
    label.addEventListener("click", () => toggle.click());
    return toggle;
  }

  private slider(control: Control, label: HTMLElement): HTMLElement[] {
    const { low, high, value } = control;
    const slider = h("input", {
      attributes: { type: "range", min: low, max: high, "aria-labelledby": label.id },
      set: { value: String(value) },
    });
    const shown = h("output", {}, String(value));
    slider.addEventListener("input", () => {
      shown.textContent = slider.value;
      this.set(control, Number(slider.value));
    });
    return [slider, shown];
  }
}

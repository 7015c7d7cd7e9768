// The watch table, what is forced, and faults.
import type { Core } from "../core/core";
import type { Watching } from "../core/watching";
import type { Status, Value } from "../core/protocol";
import type { Editors } from "../editor/editors";
import { button, h, iconButton, say, select, setAttributes } from "../page/dom";
import { icon } from "../page/icons";
import type { Tabs } from "../page/tabs";
import { FORMATS, formatted, type Format } from "./formats";
import type { Operands } from "./operands";
import type { Chosen } from "../project/chosen";

interface Row {
  operand: string;
  format: Format;
  element: HTMLTableRowElement;
  shown: HTMLElement;
  field: HTMLInputElement;
  force: HTMLButtonElement;
  release: HTMLButtonElement;
  value: Value | undefined;
}

export class Watch {
  readonly element: HTMLElement;
  /** What is forced now. */
  forced: Value[] = [];
  private rows: Row[] = [];
  private body = h("tbody");
  private table: HTMLElement;
  private none = h("p", { class: "nothing", text: "nothingWatched" });
  private forcedList = h("ul", { class: "list forced" });
  private forcedPart: HTMLElement;
  private fault = h("div", { class: "fault", attributes: { hidden: true, "aria-live": "polite" } });
  private isShown = false;
  private ask: (operands: readonly string[]) => void;

  constructor(
    private core: Core,
    watching: Watching,
    private editors: Editors,
    operands: Operands,
    private chosen: Chosen,
    private tabs: () => Tabs,
  ) {
    this.table = this.makeTable();
    this.forcedPart = h(
      "section",
      { class: "forced-part", attributes: { hidden: true } },
      h("h2", { text: "forced" }),
      this.forcedList,
      button("releaseAll", () => core.tell({ do: "unforce", operand: null })),
    );
    this.element = h(
      "div",
      {},
      this.fault,
      this.addForm(operands),
      this.none,
      h("div", { class: "scroll" }, this.table),
      this.forcedPart,
    );
    this.ask = watching.part((values) => this.fill(values));
    core.on("forced", ({ values }) => this.setForced(values));
    chosen.onOpened(() => this.begin());
    this.begin();
  }

  /** The rows that were chosen in the project that is open now. */
  private begin(): void {
    this.rows = [];
    this.body.replaceChildren();
    for (const [operand, format] of rowsIn(this.chosen.text("watch"))) this.add(operand, format);
    this.changed();
  }

  /** Values are asked for only while they can be seen. */
  shown(isShown: boolean): void {
    this.isShown = isShown;
    this.send();
  }

  private addForm(operands: Operands): HTMLElement {
    const field = operands.field("operandToWatch");
    const submit = (event: Event) => {
      event.preventDefault();
      for (const operand of field.value.split(/[\s,;]+/).filter(Boolean)) this.add(operand);
      field.value = "";
      this.changed();
    };
    return h(
      "form",
      { class: "line-form", on: { submit } },
      field,
      h("button", { text: "watchIt", attributes: { type: "submit" } }),
    );
  }

  private makeTable(): HTMLElement {
    const heads = (["operand", "value", "format", "newValue"] as const).map((text) =>
      h("th", { text, attributes: { scope: "col" } }),
    );
    const last = h(
      "th",
      { attributes: { scope: "col" } },
      h("span", { class: "hidden", text: "remove" }),
    );
    return h("table", { class: "watch" }, h("thead", {}, h("tr", {}, ...heads, last)), this.body);
  }

  private add(operand: string, format: Format = "auto"): void {
    if (this.rows.some((row) => row.operand === operand)) return;
    const shown = h("td", { class: "value" });
    const field = h("input", { attributes: { autocomplete: "off", spellcheck: "false", size: 8 } });
    say(field, "aria-label", "newValueOf", operand);
    const set = button("set", () => this.send1("set", operand, field));
    const force = button("force", () => this.send1("force", operand, field));
    const release = button("releaseIt", () => this.core.tell({ do: "unforce", operand }));
    say(set, "aria-label", "setAsk", operand);
    say(force, "aria-label", "forceAsk", operand);
    say(release, "aria-label", "release", operand);
    field.addEventListener("keydown", (event) => {
      if (event.key === "Enter") this.send1("set", operand, field);
    });
    const formats = select(
      "format",
      FORMATS.map((name) => [name, name] as const),
      format,
      (format) => this.reformat(operand, format),
    );
    say(formats, "aria-label", "formatOf", operand);
    const remove = iconButton(icon("close"), "removeOperand", () => this.remove(operand), operand);
    const element = h(
      "tr",
      {},
      h("th", { attributes: { scope: "row" } }, operand),
      shown,
      h("td", {}, formats),
      h("td", { class: "write" }, h("div", { class: "fields" }, field, set, force, release)),
      h("td", {}, remove),
    );
    this.body.append(element);
    this.rows.push({ operand, format, element, shown, field, force, release, value: undefined });
  }

  private send1(what: "set" | "force", operand: string, field: HTMLInputElement): void {
    const row = this.rows.find((row) => row.operand === operand);
    // A bit without a value is turned over: one key or click less.
    const turned = row?.value?.form === "bit" ? String(1 - (row.value.number ?? 0)) : "";
    const value = field.value.trim() || turned;
    if (value === "") field.focus();
    else this.core.tell({ do: what, operand, value });
  }

  private reformat(operand: string, format: Format): void {
    const row = this.rows.find((row) => row.operand === operand);
    if (!row) return;
    row.format = format;
    this.draw(row);
    this.keep();
  }

  private remove(operand: string): void {
    const at = this.rows.findIndex((row) => row.operand === operand);
    this.rows.splice(at, 1)[0]?.element.remove();
    (this.rows[at] ?? this.rows[at - 1])?.field.focus();
    this.changed();
  }

  private changed(): void {
    this.none.hidden = this.rows.length > 0;
    this.table.hidden = this.rows.length === 0;
    this.keep();
    this.send();
  }

  private keep(): void {
    const rows = this.rows.map(({ operand, format }) => [operand, format]);
    this.chosen.keep("watch", JSON.stringify(rows));
  }

  private send(): void {
    this.ask(this.isShown ? this.rows.map((row) => row.operand) : []);
  }

  private fill(values: Value[]): void {
    for (const [index, row] of this.rows.entries()) {
      row.value = values[index];
      this.draw(row);
    }
  }

  private draw(row: Row): void {
    const { value, shown, element } = row;
    if (!value) return;
    const text = value.problem ?? formatted(value, row.format);
    if (shown.textContent !== text) shown.textContent = text;
    element.classList.toggle("is-forced", value.forced);
    element.classList.toggle("is-on", value.form === "bit" && value.number === 1);
    element.classList.toggle("is-wrong", value.problem !== null);
    row.force.disabled = !value.canForce;
    row.release.disabled = !value.forced;
  }

  private setForced(values: Value[]): void {
    this.forced = values;
    this.forcedPart.hidden = values.length === 0;
    this.tabs().badge("watch", values.length > 0 ? `F${values.length}` : "");
    this.forcedList.replaceChildren(
      ...values.map((value) => {
        const { name, text } = value;
        const operand = name;
        const release = button("releaseIt", () => this.core.tell({ do: "unforce", operand }));
        say(release, "aria-label", "releaseForced", name);
        return h("li", {}, h("code", {}, `${name} = ${text}`), release);
      }),
    );
  }

  /** Last values that are no longer true are grey; a fault leads to its place. */
  showStatus(status: Status): void {
    if (status.mode === "OFFLINE" && this.forced.length > 0) this.setForced([]);
    this.element.classList.toggle("stale", status.mode === "LOST");
    this.fault.hidden = !status.fault;
    const place = status.faultAt;
    const words = h("strong", {}, status.fault ?? "");
    const show = place && button("showPlace", () => this.editors.openPlace(place));
    if (this.fault.firstChild?.textContent === words.textContent) return;
    this.fault.replaceChildren(words, ...(show ? [show] : []));
    setAttributes(this.fault, { class: "fault" });
  }
}

/** The rows in a text that was kept; nothing of it is believed. */
function rowsIn(text: string): [string, Format][] {
  try {
    const rows = JSON.parse(text || "[]") as unknown;
    if (!Array.isArray(rows)) return [];
    return rows.flatMap((row: unknown): [string, Format][] => {
      const [operand, name] = Array.isArray(row) ? (row as unknown[]) : [];
      const format = FORMATS.find((format) => format === name);
      return typeof operand === "string" && format ? [[operand, format]] : [];
    });
  } catch {
    return [];
  }
}

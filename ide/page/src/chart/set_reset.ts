// Charts of SFCEdit as Structured Text for other controllers: a dialog that asks for the kinds of
// their variables, with suggestions from their use, and saves the text. What is written, the module
// of charts says.
import type { Editors } from "../editor/editors";
import { button, h, select } from "../page/dom";
import { dialog } from "../page/dialog";
import { labelled } from "../panels/scope";
import { save } from "../project/files";
import type { Project } from "../project/project";
import { t, type Key } from "../text/language";
import type { DrawingsModule } from "../drawings/module";
import { stemOf } from "./paper";
import type { Converted, ConvertedVariable, ConvertTarget, Questions } from "./protocol";

const TARGETS: readonly (readonly [ConvertTarget, { plain: string }])[] = [
  ["uno200", { plain: "uno200" }],
  ["twincat", { plain: "Beckhoff TwinCAT" }],
  ["pl7", { plain: "Schneider PL7" }],
  ["plcopen", { plain: "PLCopen XML" }],
];
const KINDS = [
  ...(["signal", "input", "output", "memory", "system"] as const),
  ...(["constant", "timer", "counter"] as const),
] as const;
type Kind = (typeof KINDS)[number];
const KIND_WORDS: Record<Kind, Key> = {
  signal: "kindSignal",
  input: "kindInput",
  output: "kindOutput",
  memory: "kindMemory",
  system: "kindSystem",
  constant: "kindConstant",
  timer: "kindTimer",
  counter: "kindCounter",
};
/** The types that variables of a kind can have, as the module has them; the first one is usual. */
const VALUES = ["BOOL", "INT", "WORD", "DWORD", "REAL", "TIME"];
const typesOf = (kind: string) =>
  ({ timer: ["TON", "TOF", "TP"], counter: ["CTU", "CTD", "CTUD"] })[kind] ?? VALUES;
/** The tables, with the variables in each. */
const TABLES: readonly [Key, (kind: string) => boolean][] = [
  ["kindsOfSignals", (kind) => kind !== "timer" && kind !== "counter"],
  ["kindsOfTimers", (kind) => kind === "timer"],
  ["kindsOfCounters", (kind) => kind === "counter"],
];

/** Whether a text is a chart of SFCEdit. */
export const isOfSfcedit = (file: string | null, text: string | undefined) =>
  file !== null && /\.xml$/i.test(file) && /<grafcet\b/i.test(text ?? "");

export class SetReset {
  /** Opens the dialog, where the editor has such charts. */
  readonly element = button("chartConvert", () => void this.open(), { class: "primary" });

  constructor(
    private module: DrawingsModule<Questions>,
    private editors: Editors,
    private project: Project,
  ) {
    const show = () => (this.element.hidden = !isOfSfcedit(editors.current, this.text));
    editors.onCurrent(show);
    project.onFiles(show);
    project.onEdited(show);
    show();
  }

  private get text(): string | undefined {
    const { current } = this.editors;
    return current === null ? undefined : this.project.text(current);
  }

  private async open(): Promise<void> {
    const { text } = this;
    const file = this.editors.current;
    if (file === null || text === undefined) return;
    const table = file.replace(/\.\w+$/, ".csv");
    const kinds = new Kinds(this.module, stemOf(file), text, this.project.text(table));
    await kinds.ask();
    const keep = button("chartConvertKeep", () => {
      if (this.project.text(table) === undefined) this.project.add(table, kinds.csv());
      else this.editors.replace(table, kinds.csv());
    });
    const add = button("chartConvertAdd", () => {
      const { name, text } = kinds.made() ?? {};
      if (name === undefined || text === undefined) return;
      if (this.project.text(name) === undefined) this.project.add(name, text);
      else this.editors.replace(name, text);
      this.editors.open(name, undefined, false);
      add.closest("dialog")?.close();
    });
    kinds.onProgram((isThere) => (add.disabled = !isThere));
    const tools = h("div", { class: "controls" }, keep, add);
    const isAgreed = await dialog({
      title: t("chartConvertTitle", stemOf(file)),
      body: [tools, kinds.element],
      agree: "chartConvertSave",
    });
    const made = isAgreed ? kinds.made() : null;
    if (made) save(made.name, made.text, "text/plain");
  }
}

/** The tables, and what they mean. */
class Kinds {
  private target: ConvertTarget = "uno200";
  /** What a person has chosen, or a file has: by names. */
  private chosen = new Map<string, ConvertedVariable>();
  private converted: Converted | null = null;
  private tables = h("div", { class: "kinds" });
  private problems = h("ul", { class: "kind-problems", attributes: { "aria-live": "polite" } });
  private listeners: ((isThere: boolean) => void)[] = [];
  readonly element = h(
    "div",
    { class: "convert" },
    h("p", { class: "hint", text: "chartConvertHint" }),
    labelled(
      "chartConvertTarget",
      select("chartConvertTarget", TARGETS, this.target, (target) => {
        this.target = target;
        void this.ask();
      }),
    ),
    this.problems,
    this.tables,
  );

  constructor(
    private module: DrawingsModule<Questions>,
    private name: string,
    private text: string,
    /** The table that a file of the project has. */
    private file: string | undefined,
  ) {}

  /** Is told whether there is a program. */
  onProgram(listener: (isThere: boolean) => void): void {
    this.listeners.push(listener);
    listener(this.made() !== null);
  }

  /** The table as a file has it. */
  csv(): string {
    const variables = this.converted?.variables ?? [];
    return rowsOf(variables.map((one) => this.chosen.get(one.name) ?? one));
  }

  /** The program with the name of its file. */
  made(): { name: string; text: string } | null {
    const { program, ending } = this.converted ?? { program: null, ending: "" };
    // A project of PLCopen would take the place of the chart.
    const stem = ending === "xml" ? `${this.name}-plcopen` : this.name;
    return program === null ? null : { name: `${stem}.${ending}`, text: program };
  }

  async ask(): Promise<void> {
    const { name, text, target, file } = this;
    const variables = file ?? rowsOf([...this.chosen.values()]);
    const converted = await this.module.ask({ do: "convert", name, text, variables, target });
    this.converted = converted;
    const isWrong = converted.problems.some(({ isOfTable, isError }) => isOfTable && isError);
    if (file !== undefined && !isWrong) {
      this.file = undefined;
      for (const one of converted.variables) this.chosen.set(one.name, one);
    }
    this.show(converted);
  }

  private show({ variables, problems }: Converted): void {
    const focused = document.activeElement?.getAttribute("data-of");
    this.problems.hidden = problems.length === 0;
    this.problems.replaceChildren(
      ...problems.map(({ line, isError, message, help }) =>
        h(
          "li",
          { class: isError ? "bad" : "" },
          [`${t("chartToMistake", line)}: ${message}`, ...help].join("; "),
        ),
      ),
    );
    const tables = TABLES.map(([title, isIn]) => {
      const rows = variables.filter(({ kind }) => isIn(kind));
      return rows.length > 0 && this.table(title, rows);
    });
    this.tables.replaceChildren(...tables.filter((one) => one !== false));
    if (focused) this.tables.querySelector<HTMLElement>(`[data-of="${focused}"]`)?.focus();
    for (const listener of this.listeners) listener(this.made() !== null);
  }

  private table(title: Key, variables: ConvertedVariable[]): HTMLElement {
    const heads = (["kindName", "kindOf", "kindType", "kindValue"] as const).map((text) =>
      h("th", { text, attributes: { scope: "col" } }),
    );
    return h(
      "table",
      {},
      h("caption", { text: title }),
      h("thead", {}, h("tr", {}, ...heads)),
      h("tbody", {}, ...variables.map((one) => this.row(one))),
    );
  }

  private row(variable: ConvertedVariable): HTMLElement {
    const { name, kind, type, value } = variable;
    const choose = (change: Partial<ConvertedVariable>) => {
      this.chosen.set(name, { ...variable, ...change });
      void this.ask();
    };
    const ofKind = select(
      "kindOf",
      KINDS.map((one) => [one, KIND_WORDS[one]] as const),
      kind as Kind,
      (kind) => choose({ kind, type: typesOf(kind)[0] ?? type, value: null }),
    );
    const ofType = select(
      "kindType",
      typesOf(kind).map((one) => [one, { plain: one }] as const),
      type,
      (type) => choose({ type }),
    );
    const ofValue = h("input", {
      attributes: { autocomplete: "off", spellcheck: "false", "data-of": `${name} value` },
      set: { value: value ?? "", disabled: kind !== "constant" },
      on: { change: () => choose({ value: ofValue.value.trim() || null }) },
    });
    for (const [control, what] of [
      [ofKind, "kindOf"],
      [ofType, "kindType"],
      [ofValue, "kindValue"],
    ] as const) {
      control.setAttribute("aria-label", `${t(what)}: ${name}`);
      control.setAttribute("data-of", `${name} ${what}`);
    }
    const isGuessed = !this.chosen.has(name);
    return h(
      "tr",
      { class: isGuessed ? "guessed" : "" },
      h("th", { attributes: { scope: "row" } }, name),
      ...[ofKind, ofType, ofValue].map((control) => h("td", {}, control)),
    );
  }
}

function rowsOf(variables: ConvertedVariable[]): string {
  const row = ({ name, kind, type, value }: ConvertedVariable) =>
    `${name},${kind},${type}${value === null ? "" : ` := ${value}`}\n`;
  return `name,kind,type\n${variables.map(row).join("")}`;
}

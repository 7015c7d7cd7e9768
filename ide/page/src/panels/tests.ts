// Scenarios of the project as tests: green, or red at the line that failed.
import { Refusal, type Core } from "../core/core";
import type { TestResult } from "../core/protocol";
import type { Editors } from "../editor/editors";
import { button, h, say } from "../page/dom";
import type { Tabs } from "../page/tabs";
import type { Project } from "../project/project";
import { inLanguage, onLanguage, t } from "../text/language";

type Outcome = TestResult | { refused: string } | "running";

export class Tests {
  readonly element: HTMLElement;
  private list = h("ul", { class: "list tests", attributes: { "aria-live": "polite" } });
  private all: HTMLButtonElement;
  private none = h("p", { class: "nothing", text: "noScenarios" });
  private outcomes = new Map<string, Outcome>();

  constructor(
    private core: Core,
    private project: Project,
    private editors: Editors,
    private tabs: () => Tabs,
  ) {
    this.all = button("testAll", () => void this.runAll(), { class: "primary" });
    this.element = h("div", {}, h("div", { class: "controls" }, this.all), this.none, this.list);
    project.onFiles(() => this.draw());
    project.onOpened(() => this.outcomes.clear());
    // A result belongs to the texts that were tested.
    project.onEdited(() => {
      if (this.outcomes.size === 0) return;
      this.outcomes.clear();
      this.draw();
    });
    onLanguage(() => this.draw());
  }

  private files(): string[] {
    return this.project.names().filter((name) => /\.scn$/i.test(name));
  }

  private async runAll(): Promise<void> {
    for (const file of this.files()) await this.run(file);
  }

  private async run(file: string): Promise<void> {
    this.outcomes.set(file, "running");
    this.draw();
    let outcome: Outcome;
    try {
      outcome = await this.core.ask({ do: "test", file });
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      outcome = { refused: error.message };
    }
    this.outcomes.set(file, outcome);
    this.draw();
  }

  private draw(): void {
    const files = this.files();
    this.none.hidden = files.length > 0;
    this.all.disabled = files.length === 0;
    this.list.replaceChildren(...files.map((file) => this.row(file, this.outcomes.get(file))));
    const done = files.map((file) => this.outcomes.get(file)).filter(isDone);
    const bad = done.filter((outcome) => !isGood(outcome)).length;
    const text = bad > 0 ? String(bad) : done.length > 0 && done.length === files.length ? "✓" : "";
    this.tabs().badge("tests", text, bad > 0 ? "bad" : "good");
  }

  private row(file: string, outcome: Outcome | undefined): HTMLElement {
    const open = h(
      "button",
      {
        class: "row",
        attributes: { type: "button" },
        on: { click: () => this.editors.open(file) },
      },
      mark(outcome),
      h("span", {}, file),
      h("span", { class: "where" }, words(outcome)),
    );
    const test = button("test", () => void this.run(file), { class: "small" });
    say(test, "aria-label", "testFile", file);
    const item = h("li", {}, h("div", { class: "head" }, open, test));
    if (typeof outcome === "object" && "refused" in outcome)
      item.append(h("p", { class: "refused" }, outcome.refused));
    else if (typeof outcome === "object") item.append(this.failures(file, outcome));
    return item;
  }

  private failures(file: string, result: TestResult): HTMLElement {
    const rows = result.failures.map(([line, text]) => {
      const show = () => this.editors.openLine(file, line);
      const words = h("span", { class: "message" }, text);
      // What has to do with no line has the line 0.
      const where = h("span", { class: "where" }, line > 0 ? `${file}:${line}` : file);
      const attributes = { type: "button" };
      return h(
        "li",
        {},
        h("button", { class: "row", attributes, on: { click: show } }, where, words),
      );
    });
    const plant = result.plant && h("p", { class: "hint" }, result.plant);
    const goal = !result.passed && result.goal && h("p", {}, inLanguage(result.goal));
    return h("div", { class: "more" }, goal, h("ul", { class: "list" }, ...rows), plant);
  }
}

function isDone(outcome: Outcome | undefined): outcome is TestResult | { refused: string } {
  return typeof outcome === "object";
}

function isGood(outcome: TestResult | { refused: string }): boolean {
  return "passed" in outcome && outcome.passed;
}

function mark(outcome: Outcome | undefined): HTMLElement {
  if (!isDone(outcome))
    return h("span", { class: "mark", attributes: { "aria-hidden": "true" } }, "○");
  const good = isGood(outcome);
  const label = good ? "passed" : "failed";
  return h(
    "span",
    { class: `mark ${label}`, label, attributes: { role: "img" } },
    good ? "✓" : "✗",
  );
}

function words(outcome: Outcome | undefined): string {
  if (outcome === undefined) return t("notTested");
  if (outcome === "running") return t("testing");
  if ("refused" in outcome) return t("failed");
  return t("testDone", outcome.scans.toLocaleString(), outcome.met, outcome.failures.length);
}

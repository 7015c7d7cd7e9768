// Exercises: the list to choose from; of the one that is open its text, and what is still missing.
import { Refusal, type Core } from "../core/core";
import type { TestResult } from "../core/protocol";
import { markdown } from "../editor/markdown";
import { confirm } from "../page/dialog";
import { button, h, say } from "../page/dom";
import { notice } from "../page/notices";
import { unfitWords } from "../page/unfit";
import { keptProject } from "../project/begin";
import {
  exercise,
  exerciseAnew,
  exerciseId,
  exerciseOf,
  listed,
  rememberSolved,
  solved,
  type Exercise,
  type Listed,
} from "../project/exercises";
import type { Open } from "../project/opening";
import { Unfit, type Project } from "../project/project";
import { inLanguage, onLanguage } from "../text/language";

export class Exercises {
  readonly element: HTMLElement;
  private list: Listed[] = [];
  private chosen: Exercise | null = null;
  /** Whether the list is to be seen although one is open. */
  private isListed = false;
  private results: TestResult[] = [];
  private refused = "";
  private place = h("div", {});
  private outcome = h("div", { class: "outcome", attributes: { "aria-live": "polite" } });

  constructor(
    private core: Core,
    project: Project,
    private open: Open,
    private current: () => { id: string },
  ) {
    this.element = h("div", { class: "exercises" }, this.place);
    project.onOpened(() => void this.opened());
    project.onEdited(() => this.forget());
    onLanguage(() => this.draw());
  }

  /** The panel can be seen, or no longer. */
  shown(isShown: boolean): void {
    if (isShown && this.list.length === 0) void this.fetchList();
  }

  private async fetchList(): Promise<void> {
    this.list = await listed();
    this.draw();
  }

  private async opened(): Promise<void> {
    const name = exerciseOf(this.current().id);
    this.isListed = false;
    this.chosen = name === null ? null : await exercise(name).catch(() => null);
    this.forget();
  }

  /** What was found out belongs to the texts that were checked. */
  private forget(): void {
    [this.results, this.refused] = [[], ""];
    this.draw();
  }

  private draw(): void {
    const isChosen = this.chosen !== null && !this.isListed;
    this.place.replaceChildren(...(isChosen ? this.page(this.chosen as Exercise) : this.choice()));
    this.drawOutcome();
  }

  private choice(): HTMLElement[] {
    if (this.list.length === 0) return [h("p", { class: "nothing", text: "noExercises" })];
    const done = solved();
    const rows = this.list.map((one) => this.row(one, done.has(one.name)));
    return [
      h("p", { class: "hint", text: "chooseExercise" }),
      h("ol", { class: "list exercise-list" }, ...rows),
    ];
  }

  private row({ name, title }: Listed, isSolved: boolean): HTMLElement {
    const row = h(
      "button",
      { class: "row", attributes: { type: "button" }, on: { click: () => void this.choose(name) } },
      mark(isSolved),
      h("span", {}, inLanguage(title)),
    );
    if (isSolved) row.append(h("span", { class: "where", text: "solved" }));
    return h("li", {}, row);
  }

  private page({ title, text }: Exercise): HTMLElement[] {
    const check = button("check", () => void this.check(), { class: "primary" });
    return [
      h("h2", {}, inLanguage(title)),
      markdown(inLanguage(text)),
      h(
        "div",
        { class: "controls" },
        check,
        button("allExercises", () => this.showList()),
        button("exerciseAnew", () => void this.anew()),
      ),
      this.outcome,
    ];
  }

  private showList(): void {
    this.isListed = true;
    this.draw();
    if (this.list.length === 0) void this.fetchList();
  }

  private async choose(name: string): Promise<void> {
    try {
      await this.open(keptProject(exerciseId(name)) ?? exerciseAnew(name));
    } catch (error) {
      notice(error instanceof Unfit ? unfitWords(error) : String(error), true);
    }
  }

  private async anew(): Promise<void> {
    if (!this.chosen || !(await confirm("exerciseAnew", "exerciseAnewAsk", "beginAnew"))) return;
    await this.open(exerciseAnew(this.chosen.name));
  }

  /** Runs the hidden scenarios, one after the other. */
  private async check(): Promise<void> {
    const { chosen } = this;
    if (!chosen) return;
    this.forget();
    for (const { name, text } of chosen.scenarios)
      try {
        const wish = { name, text, plants: chosen.plants };
        const result = await this.core.ask({ do: "check", ...wish });
        if (chosen !== this.chosen) return;
        this.results.push(result);
      } catch (error) {
        if (!(error instanceof Refusal)) throw error;
        this.refused = error.message;
        break;
      }
    if (this.isSolved()) rememberSolved(chosen.name);
    this.drawOutcome();
  }

  private isSolved(): boolean {
    const { results, chosen } = this;
    return results.length === chosen?.scenarios.length && results.every(({ passed }) => passed);
  }

  private drawOutcome(): void {
    const done = this.results.filter(({ passed }) => passed).length;
    const words = h("p", { class: "summary" });
    if (this.isSolved()) say(words, "text", "exerciseSolved");
    else if (this.results.length > 0) say(words, "text", "behaviours", done, this.results.length);
    const refused = this.refused && h("p", { class: "refused" }, this.refused);
    const items = this.results.map((result) => behaviour(result));
    this.outcome.replaceChildren(words, h("ul", { class: "list tests" }, ...items));
    if (refused) this.outcome.prepend(refused);
  }
}

/** What is wanted, whether it is there, and if not what was seen first in its place. */
function behaviour({ passed, goal, failures }: TestResult): HTMLElement {
  const words = h("span", {}, goal ? inLanguage(goal) : "");
  const item = h("li", {}, h("div", { class: "behaviour" }, mark(passed, true), words));
  const first = failures[0];
  if (!passed && first) item.append(h("p", { class: "hint" }, first[1]));
  return item;
}

function mark(isGood: boolean, isChecked = false): HTMLElement {
  if (!isGood && !isChecked)
    return h("span", { class: "mark", attributes: { "aria-hidden": "true" } }, "○");
  const label = isGood ? (isChecked ? "behaviourDone" : "solved") : "behaviourMissing";
  return h(
    "span",
    { class: `mark ${isGood ? "passed" : "failed"}`, label, attributes: { role: "img" } },
    isGood ? "✓" : "✗",
  );
}

// The list of what is wrong, and what the program takes.
import type { Core } from "../core/core";
import type { Problem, Summary } from "../core/protocol";
import type { Editors } from "../editor/editors";
import { button, h } from "../page/dom";
import type { Tabs } from "../page/tabs";
import { onLanguage, t } from "../text/language";

/** More are not drawn: nobody reads them, and drawing takes time after each key. */
const SHOWN_MAX = 100;
/** From drawing to drawing at least, while somebody types. */
const DRAW_MS = 200;

export class Problems {
  readonly element: HTMLElement;
  private list = h("ul", { class: "list problems" });
  private summary = h("p", { class: "summary" });
  private none = h("p", { class: "nothing", text: "noProblems" });
  private problems: Problem[] = [];
  private program: Summary | null = null;
  private more = h("p", { class: "hint" });
  private timer = 0;
  private drawnAt = 0;

  constructor(
    core: Core,
    private editors: Editors,
    private explain: (code: string) => void,
    private tabs: () => Tabs,
  ) {
    this.element = h("div", {}, this.summary, this.none, this.list, this.more);
    core.on("problems", ({ problems }) => {
      this.problems = problems;
      this.soon();
    });
    core.on("program", ({ program }) => {
      this.program = program;
      this.drawSummary();
    });
    onLanguage(() => {
      this.draw();
      this.drawSummary();
    });
  }

  /** Draws at once where nothing was drawn for a while. */
  private soon(): void {
    clearTimeout(this.timer);
    const wait = Math.max(0, this.drawnAt + DRAW_MS - performance.now());
    this.timer = window.setTimeout(() => this.draw(), wait);
  }

  private draw(): void {
    const { problems } = this;
    this.drawnAt = performance.now();
    const left = problems.length - SHOWN_MAX;
    this.more.hidden = left <= 0;
    this.more.textContent = t("moreProblems", left);
    this.none.hidden = problems.length > 0;
    this.list.replaceChildren(...problems.slice(0, SHOWN_MAX).map((problem) => this.row(problem)));
    const hasError = problems.some((problem) => problem.isError);
    const text = problems.length === 0 ? "" : String(problems.length);
    this.tabs().badge("problems", text, hasError ? "bad" : "");
  }

  private row(problem: Problem): HTMLElement {
    const { file, line, column, message, code, isError, help, suggestion } = problem;
    const kind = isError ? "error" : "warning";
    const show = () => this.editors.openPlace(problem);
    const open = h(
      "button",
      { class: "row", attributes: { type: "button" }, on: { click: show } },
      h("span", { class: `kind ${kind}`, text: kind }),
      h("span", { class: "message" }, message),
      h("span", { class: "where" }, `${file}:${line}:${column}`),
    );
    const more = h("div", { class: "more" });
    if (code) more.append(this.code(code));
    more.append(...help.map((words) => h("span", { class: "help" }, words)));
    if (suggestion !== null) more.append(this.fix(problem, suggestion));
    for (const [place, words] of problem.related)
      more.append(this.related(place.file, words, () => this.editors.openPlace(place)));
    return h("li", {}, open, more);
  }

  private code(code: string): HTMLElement {
    return h(
      "button",
      {
        class: "link code",
        attributes: { type: "button" },
        on: { click: () => this.explain(code) },
      },
      code,
    );
  }

  private fix(problem: Problem, suggestion: string): HTMLElement {
    const { file, from, to } = problem;
    const fix = button("replaceBy", () => {
      this.editors.apply([{ file, from, to, text: suggestion }]);
      this.editors.open(file, { from, to: from + suggestion.length });
    });
    fix.replaceChildren(t("replaceBy", suggestion));
    fix.removeAttribute("title");
    fix.className = "small";
    return fix;
  }

  private related(file: string, words: string, show: () => void): HTMLElement {
    return h(
      "button",
      { class: "link", attributes: { type: "button" }, on: { click: show } },
      `${file}: ${words}`,
    );
  }

  private drawSummary(): void {
    const { program } = this;
    this.summary.hidden = !program;
    if (!program) return;
    const parts = [
      t("takesInstructions", program.file, program.instructions),
      t("takesBytes", program.bytes, program.bytesMax),
      t("takesData", program.data, program.dataMax),
    ];
    if (program.longestUs !== null) parts.push(t("longestScan", program.longestUs.toFixed(0)));
    if (!program.fitsUno) parts.push(t("tooLargeForUno"));
    this.summary.textContent = parts.join(" · ");
  }
}

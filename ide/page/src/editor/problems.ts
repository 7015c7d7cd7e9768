// What is wrong, underlined in the text with message, help and quick fix.
import { setDiagnostics, type Action, type Diagnostic } from "@codemirror/lint";
import type { EditorState, TransactionSpec } from "@codemirror/state";
import type { EditorView } from "@codemirror/view";
import type { Problem } from "../core/protocol";
import { h } from "../page/dom";
import { t } from "../text/language";

/** What happens when the code of a problem is chosen. */
export type Explain = (code: string) => void;

/** Shows the problems of a file. */
export function show(state: EditorState, problems: Problem[], explain: Explain): TransactionSpec {
  return setDiagnostics(
    state,
    problems.map((problem) => diagnostic(state, problem, explain)),
  );
}

function diagnostic(state: EditorState, problem: Problem, explain: Explain): Diagnostic {
  // The text may be newer than what the core has seen; then new problems are on their way.
  const length = state.doc.length;
  const from = Math.min(problem.from, length);
  const to = Math.min(Math.max(problem.to, from), length);
  return {
    from,
    to,
    severity: problem.isError ? "error" : "warning",
    source: problem.code,
    message: problem.message,
    renderMessage: () => message(problem),
    actions: actions(problem, explain),
  };
}

function message(problem: Problem): HTMLElement {
  const help = problem.help.map((help) => h("p", { class: "help" }, help));
  return h("div", {}, h("p", {}, problem.message), ...help);
}

function actions(problem: Problem, explain: Explain): Action[] {
  const actions: Action[] = [];
  const { suggestion, code } = problem;
  if (suggestion !== null)
    actions.push({
      name: t("replaceBy", suggestion),
      apply: (view: EditorView, from: number, to: number) =>
        view.dispatch({ changes: { from, to, insert: suggestion }, userEvent: "input.fix" }),
    });
  if (code !== "") actions.push({ name: t("explain", code), apply: () => explain(code) });
  return actions;
}

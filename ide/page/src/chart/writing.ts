// Opens the field for a part of a chart: a name, a condition, an action, a comment, the steps that
// a new transition leads to.
import { Refusal, type Core } from "../core/core";
import { t, type Args, type Key } from "../text/language";
import { barFrame, type Item, type StepItem } from "./drawn";
import type { ChartEditor } from "./editor";
import { variables, stepNames, stepOf } from "./names";
import type { ChartTransition, Edit, Frame } from "./protocol";
import { line, wanted } from "./written";

/** The last number that a priority can be. */
const PRIORITY_MAX = 4_294_967_295;

export class Writing {
  constructor(
    private editor: ChartEditor,
    private core: Core,
  ) {}

  /** The name of a step, a condition, or the action that is selected. */
  part(): void {
    const { scene } = this.editor;
    const { focus, action } = scene ?? {};
    if (!focus) return;
    if (focus.kind === "transition") this.condition(focus);
    else if (typeof action === "number") this.action(focus, action);
    else this.name(focus);
  }

  private name(step: StepItem): void {
    const { id, element } = step;
    const label: [Key, ...Args] = ["chartNameOf", element.fullName];
    this.open(step, label, element.fullName, element.frame, [], (name) => ({
      rename: { step: id, name },
    }));
  }

  private condition(item: Item & { kind: "transition" }): void {
    const { title, condition } = item.element;
    const at = barFrame(item.element);
    this.open(item, ["chartConditionOf", title], condition, at, this.variables(item), (text) => ({
      setCondition: { transition: item.id, text },
    }));
  }

  /** The name of a transition; without one it has none. */
  title(): void {
    this.ofTransition(
      "chartTitleOf",
      ({ name }) => name,
      (name) => ({ name }),
    );
  }

  /** Its priority. */
  priority(): void {
    this.ofTransition(
      "chartPriorityOf",
      ({ priority }) => priority,
      (text) => ({ priority: text === null ? null : priorityOf(text) }),
    );
  }

  private ofTransition(
    label: Key,
    read: (element: ChartTransition) => string | number | null,
    change: (text: string | null) => Partial<ChartTransition>,
  ): void {
    const item = this.editor.scene?.focus;
    if (item?.kind !== "transition") return;
    const { element } = item;
    const value = String(read(element) ?? "");
    this.open(item, [label, element.title], value, barFrame(element), [], (text) => {
      const { name, priority, from, to } = { ...element, ...change(text === "" ? null : text) };
      return { setTransition: { transition: item.id, name, priority, from, to } };
    });
  }

  private action(step: StepItem, index: number): void {
    const action = step.element.actions[index];
    if (!action) return;
    if (!action.written) return this.editor.goToText();
    const label: [Key, ...Args] = ["chartActionOf", step.element.fullName];
    const names = this.variables(step);
    this.open(step, label, line(action.written), action.frame, names, (text) =>
      text === ""
        ? { removeAction: { step: step.id, index } }
        : { setAction: { step: step.id, index, action: wanted(text) } },
    );
  }

  /** One more action of the step that is selected. */
  newAction(): void {
    const step = this.step();
    if (!step) return;
    const { frame, actions, fullName } = step.element;
    const last = actions.at(-1)?.frame;
    const at: Frame = last
      ? [last[0], last[1] + last[3], last[2], last[3]]
      : [frame[0] + frame[2] + 20, frame[1], frame[2], frame[3]];
    const label: [Key, ...Args] = ["chartActionOf", fullName];
    const index = actions.length;
    this.open(step, label, "", at, this.variables(step), (text) => ({
      insertAction: { step: step.id, index, action: wanted(text) },
    }));
  }

  comment(): void {
    const { scene } = this.editor;
    const item = scene?.focus;
    if (!item) return;
    const { element } = item;
    const name = item.kind === "step" ? item.element.fullName : item.element.title;
    const at = item.kind === "step" ? item.element.frame : barFrame(item.element);
    this.open(item, ["chartCommentOf", name], element.comment, at, [], (text) => ({
      comment: { of: item.id, text },
    }));
  }

  /** A transition from the selected steps to those whose names are written. */
  connectTo(): void {
    const { scene } = this.editor;
    const from = scene?.items.filter((item) => item.kind === "step") ?? [];
    const last = from.at(-1);
    if (!scene || !last) return this.editor.tell(t("chartSelectStep"));
    const names = stepNames(scene.drawn, scene.sheet);
    const [x, y, width, height] = last.element.frame;
    const label: [Key, ...Args] = [
      "chartConnectOf",
      from.map(({ element }) => element.fullName).join(", "),
    ];
    this.open(last, label, "", [x, y + height + 6, width, height], names, (text) => {
      const to = text
        .split(/[\s,]+/)
        .filter(Boolean)
        .map((name) => {
          const step = stepOf(scene.drawn, scene.sheet, name);
          if (!step) throw new Refusal(t("chartNoStep", name));
          return step;
        });
      return { connect: { from: from.map(({ id }) => id), to } };
    });
  }

  private step(): StepItem | undefined {
    const [item, other] = this.editor.scene?.items ?? [];
    if (item?.kind === "step" && !other) return item;
    this.editor.tell(t("chartSelectStep"));
    return undefined;
  }

  private async variables(item: Item): Promise<string[]> {
    const { drawn, file, text } = this.editor.document;
    if (!drawn || file === null || text === null) return [];
    return variables(this.core, file, text, drawn, item);
  }

  private open(
    item: Item,
    label: [Key, ...Args],
    value: string,
    at: Frame,
    names: string[] | Promise<string[]>,
    edit: (text: string) => Edit,
  ): void {
    const { editor } = this;
    if (editor.field.isOpen) return;
    const { reading } = editor.document;
    editor.field.open(
      {
        label,
        value,
        at,
        names: Promise.resolve(names),
        take: async (text) => void (await editor.change(item.sheet, [edit(text)], reading)),
        done: (early, isLeft) => editor.goOn(early, isLeft),
      },
      editor.takeWritten(),
    );
  }
}

function priorityOf(text: string): number {
  const priority = /^\d+$/.test(text) ? Number(text) : NaN;
  if (priority <= PRIORITY_MAX) return priority;
  throw new Refusal(t("chartNoPriority", text, PRIORITY_MAX));
}

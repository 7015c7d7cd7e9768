// What can be done with a chart, with its keys and words, and why something cannot be done now.
import type { Core } from "../core/core";
import { t, type Key } from "../text/language";
import { Clipboard } from "./clipboard";
import { EDITS, meaning, type EditName } from "./edits";
import type { ChartEditor } from "./editor";
import { Writing } from "./writing";

/** So long nothing is asked for while somebody selects on. */
const QUIET_MS = 60;

export type OtherName = keyof Commands["others"];
export type CommandName = EditName | OtherName;

interface Said {
  text: Key;
  /** As the event of the keyboard has them, with what is held before them. */
  keys: readonly string[];
}

/** Words and keys; the first key is the one that menus show. */
export const SAID: Record<CommandName, Said> = {
  after: { text: "chartAfter", keys: ["N", "Insert"] },
  before: { text: "chartBefore", keys: ["Shift+N"] },
  parallel: { text: "chartParallel", keys: ["P"] },
  alternative: { text: "chartAlternative", keys: ["B"] },
  alone: { text: "chartAlone", keys: ["S"] },
  connect: { text: "chartConnect", keys: ["Shift+C"] },
  connectTo: { text: "chartConnectTo", keys: ["C"] },
  action: { text: "chartNewAction", keys: ["A"] },
  actionUp: { text: "chartActionUp", keys: ["Alt+ArrowUp"] },
  actionDown: { text: "chartActionDown", keys: ["Alt+ArrowDown"] },
  initial: { text: "chartMakeInitial", keys: ["I"] },
  write: { text: "chartWrite", keys: ["Enter", "F2"] },
  title: { text: "chartTitle", keys: ["T"] },
  priority: { text: "chartPriority", keys: ["R"] },
  comment: { text: "chartComment", keys: ["K"] },
  erase: { text: "chartErase", keys: ["Delete", "Backspace"] },
  copy: { text: "chartCopy", keys: ["Ctrl+C"] },
  cut: { text: "chartCut", keys: ["Ctrl+X"] },
  paste: { text: "chartPaste", keys: ["Ctrl+V"] },
  duplicate: { text: "chartDuplicate", keys: ["Ctrl+D"] },
  all: { text: "chartAll", keys: ["Ctrl+A"] },
  alignLeft: { text: "chartAlignLeft", keys: [] },
  alignTop: { text: "chartAlignTop", keys: [] },
  layout: { text: "chartLayout", keys: [] },
  goToText: { text: "chartToText", keys: ["F12"] },
  undo: { text: "chartUndo", keys: ["Ctrl+Z"] },
  redo: { text: "chartRedo", keys: ["Ctrl+Y", "Ctrl+Shift+Z"] },
  larger: { text: "drawingLarger", keys: ["+", "Shift++"] },
  smaller: { text: "drawingSmaller", keys: ["-"] },
  fit: { text: "drawingFit", keys: ["0"] },
  find: { text: "chartFind", keys: ["Ctrl+F"] },
  blocks: { text: "chartBlocks", keys: [] },
  svg: { text: "chartSvg", keys: [] },
  png: { text: "chartPng", keys: [] },
  print: { text: "chartPrint", keys: ["Ctrl+P"] },
  fold: { text: "chartFold", keys: ["M"] },
  foldAll: { text: "chartFoldAll", keys: ["Shift+M"] },
  activate: { text: "chartActivate", keys: ["X"] },
  momentBack: { text: "chartMomentBack", keys: [","] },
  momentForward: { text: "chartMomentForward", keys: ["."] },
  momentNow: { text: "chartMomentNow", keys: ["L"] },
  oneScan: { text: "chartOneScan", keys: ["F10"] },
  times: { text: "chartTimes", keys: ["G"] },
  timesSvg: { text: "chartTimesSvg", keys: [] },
  timesPng: { text: "chartTimesPng", keys: [] },
};

/** Those that open a field. */
const WRITES: readonly CommandName[] = [
  ...(["write", "title", "priority", "action", "comment", "connectTo", "find"] as const),
];
/** Those that change nothing. */
const READS: readonly CommandName[] = [
  ...(["copy", "all", "goToText", "larger", "smaller", "fit"] as const),
  ...(["find", "blocks", "svg", "png", "print", "foldAll"] as const),
  ...(["oneScan", "times", "timesSvg", "timesPng"] as const),
];

export class Commands {
  readonly clipboard: Clipboard;
  private writing: Writing;
  private reasons = new Map<EditName, string>();
  private timer = 0;
  /** So often something else was selected. */
  private changes = 0;
  private listeners: (() => void)[] = [];

  constructor(
    private editor: ChartEditor,
    core: Core,
  ) {
    this.writing = new Writing(editor, core);
    this.clipboard = new Clipboard(editor);
    editor.selection.onChange(() => this.changed());
  }

  /** What is not an edit of what is selected. */
  private readonly others = {
    write: () => this.writing.part(),
    action: () => this.writing.newAction(),
    title: () => this.writing.title(),
    priority: () => this.writing.priority(),
    comment: () => this.writing.comment(),
    connectTo: () => this.writing.connectTo(),
    copy: () => this.clipboard.copy(),
    cut: () => this.clipboard.cut(),
    paste: () => this.clipboard.pasteFromSystem(),
    duplicate: () => this.clipboard.duplicate(),
    all: () => this.editor.selectAll(),
    goToText: () => this.editor.goToText(),
    undo: () => this.editor.document.goBack(true),
    redo: () => this.editor.document.goBack(false),
    larger: () => this.editor.canvas.zoomBy(1),
    smaller: () => this.editor.canvas.zoomBy(-1),
    fit: () => this.editor.canvas.fit(),
    find: () => this.editor.find.open(this.editor.takeWritten()),
    blocks: () => this.editor.canvas.showBlocks(!this.editor.canvas.hasBlocks),
    svg: () => this.editor.pictures.svg(),
    png: () => this.editor.pictures.png(),
    print: () => this.editor.pictures.print(),
    fold: () => this.editor.folding.toggle(),
    foldAll: () => this.editor.folding.toggleAll(),
    activate: () => this.activate(),
    momentBack: () => this.editor.moments.go(-1),
    momentForward: () => this.editor.moments.go(1),
    momentNow: () => this.editor.moments.now(),
    oneScan: () => this.editor.moments.oneScan(),
    times: () => this.editor.times.toggle(),
    timesSvg: () => this.editor.times.saveSvg(),
    timesPng: () => this.editor.times.savePng(),
  };

  /** Is told when something else can be done. */
  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  /** The command of a key. */
  ofKey(key: string): CommandName | undefined {
    const names = Object.keys(SAID) as CommandName[];
    return names.find((name) => SAID[name].keys.includes(key));
  }

  opensField(name: CommandName): boolean {
    return WRITES.includes(name);
  }

  /** Does it, after what is being done. */
  run(name: CommandName): Promise<void> {
    return this.editor.perform(async () => {
      const why = this.why(name);
      if (why !== null) return this.editor.tell(why);
      if (isEdit(name)) await this.edit(name);
      else await this.others[name]();
    });
  }

  private async edit(name: EditName): Promise<void> {
    const { editor } = this;
    const { scene } = editor;
    const found = scene && meaning(name, scene);
    if (!scene || !found) return;
    if ("why" in found) return editor.tell(t(found.why));
    await editor.change(scene.sheet, [found.edit]);
    editor.focus();
  }

  /** Why it cannot be done; null if it can, as far as is known. */
  why(name: CommandName): string | null {
    const { scene, document } = this.editor;
    if (name === "undo" || name === "redo")
      return document.canGoBack(name === "undo") ? null : t("chartNoChange");
    if (READS.includes(name)) return null;
    const running = this.whyRunning(name);
    if (running !== undefined) return running;
    if (!scene) return t("chartNothing");
    const { mistake } = scene.drawn.charts;
    if (mistake) return t("chartMistake", mistake.line, mistake.message);
    if (!isEdit(name)) return document.file === null ? t("chartNothing") : this.whyOther(name);
    const found = meaning(name, scene);
    return "why" in found ? t(found.why) : (this.reasons.get(name) ?? null);
  }

  private activate(): void {
    const { scene, live } = this.editor;
    if (scene?.focus?.kind === "step") live.activate(scene.focus);
  }

  /** Of what has to do with the running program, and of macro-steps. */
  private whyRunning(name: CommandName): string | null | undefined {
    const { scene, live, folding } = this.editor;
    const { trail } = live;
    if (name === "momentBack") return trail.canGo(-1) ? null : t("chartNoMoment");
    if (name === "momentForward" || name === "momentNow")
      return trail.canGo(1) ? null : t("chartNoMoment");
    if (name === "fold") return folding.chosen === null ? t("chartSelectMacro") : null;
    if (name !== "activate") return undefined;
    if (scene?.focus?.kind !== "step") return t("chartSelectStep");
    if (scene.focus.element.look === "macro") return t("chartActivateMacro");
    if (!live.canActivate) return t("chartActivateWhere");
    return trail.at === null ? null : t("chartActivatePast");
  }

  private whyOther(name: OtherName): string | null {
    const { items, focus } = this.editor.scene ?? {};
    const isStep = items?.some(({ kind }) => kind === "step");
    if (name === "action" && (items?.length !== 1 || !isStep)) return t("chartSelectStep");
    if ((name === "connectTo" || name === "duplicate" || name === "cut") && !isStep)
      return t("chartSelectStep");
    if ((name === "title" || name === "priority") && focus?.kind !== "transition")
      return t("chartSelectTransition");
    if ((name === "write" || name === "comment") && !focus) return t("chartSelectOne");
    return null;
  }

  private changed(): void {
    this.reasons.clear();
    this.changes += 1;
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.ask(), QUIET_MS);
  }

  /** Which edits of what is selected the chart does not allow. */
  private async ask(): Promise<void> {
    const number = this.changes;
    const { scene, document } = this.editor;
    if (!scene?.drawn.isEditable || document.file === null) return;
    const wished = EDITS.flatMap((name) => {
      const found = meaning(name, scene);
      return "edit" in found ? [{ name, edit: found.edit }] : [];
    });
    const edits = wished.map(({ edit }) => edit);
    // Without an answer nothing is known against an edit; carried out it tells by itself.
    const answers = await document.allowed(scene.sheet, edits).catch(() => null);
    if (!answers || number !== this.changes) return;
    this.clipboard.prepare();
    for (const [at, { name }] of wished.entries()) {
      const why = answers[at];
      if (why) this.reasons.set(name, why);
    }
    for (const listener of this.listeners) listener();
  }
}

function isEdit(name: CommandName): name is EditName {
  return (EDITS as readonly CommandName[]).includes(name);
}

// How charts are on the target, as the core tells, by the names of chart and step: while a chart is
// edited they are shown as they were told of the text before. What is shown is now, or a moment of
// the trail.
import type { Core } from "../core/core";
import type { EventOf, Status } from "../core/protocol";
import { tellsOfProgram, type Header } from "../page/header";
import type { Operands } from "../panels/operands";
import type { ChartDocument } from "./document";
import type { Drawn, Item, StepItem, TransitionItem } from "./drawn";
import { Judging } from "./judging";
import type { ChartOperand, ElementId } from "./protocol";
import { seconds, Trail } from "./trail";
import { noteOf, timeOf, type Note } from "./note";
import { roomFor } from "./room";

type States = Map<string, boolean | null>;

/** What was asked for: steps by the names that they had at that time, and operands. */
interface Asked {
  id: number;
  names: string[][];
  operands: string[];
  /** Which of the operands are in the condition of a transition, by its key. */
  inConditions: Map<string, number[]>;
  reading: number;
}

/** A step in the situations that are told: the numbers of its chart and its place there. */
export interface Row {
  name: string;
  chart: number;
  step: number;
}

const NOTHING: Asked = { id: 0, names: [], operands: [], inConditions: new Map(), reading: 0 };

export class Live {
  readonly trail = new Trail();
  status: Status | undefined;
  private asked = NOTHING;
  private told: EventOf<"situation"> | null = null;
  private states: States = new Map();
  private times = new Map<string, string>();
  private crossed = new Set<string>();
  private judging: Judging;
  private isShown = false;
  /** So often the core was asked: the last answer counts. */
  private questions = 0;
  private listeners: (() => void)[] = [];

  constructor(
    private core: Core,
    private document: ChartDocument,
    private operands: Operands,
    header: Header,
  ) {
    this.judging = new Judging(document, () => this.tell());
    document.onDrawn((_drawn, before) => {
      // What is active in one file says nothing of another one.
      if (!before) this.forget();
      void this.ask();
    });
    core.on("problems", () => void this.ask());
    core.on("program", () => void this.ask());
    core.on("situation", (situation) => {
      this.told = situation;
      this.take();
    });
    this.status = header.status;
    header.onStatus((status) => this.takeStatus(status));
  }

  /** Is told when something else is to be seen. */
  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  private tell(): void {
    for (const listener of this.listeners) listener();
  }

  private takeStatus(status: Status): void {
    const was = this.hasOther;
    this.status = status;
    if (!tellsOfProgram(status) && this.told) {
      this.told = null;
      this.trail.miss();
      this.forgetStates();
      this.tell();
    } else if (was !== this.hasOther) this.tell();
  }

  /** Whether the target has another program, such as that before a change. */
  get hasOther(): boolean {
    const { mode, agreement } = this.status ?? { mode: "OFFLINE", agreement: "none" };
    return agreement === "other" && mode !== "OFFLINE" && mode !== "LOST" && mode !== "LOADING";
  }

  private forget(): void {
    this.trail.clear();
    this.forgetStates();
    this.tell();
  }

  private forgetStates(): void {
    this.states.clear();
    this.times.clear();
    this.crossed.clear();
    this.judging.forget();
  }

  /** A target is asked only while charts can be seen; the simulator loses nothing by it. */
  shown(isShown: boolean): void {
    const was = this.isShown;
    this.isShown = isShown;
    if (isShown) return void this.ask();
    if (!was || this.status?.target === "simulator") return;
    this.trail.miss();
    void this.ask();
  }

  /** Whether the target is to be asked. */
  private get isFollowing(): boolean {
    return this.isShown || this.status?.target === "simulator";
  }

  private async ask(): Promise<void> {
    const { document } = this;
    const file = (this.isFollowing && document.file) || "";
    // The core knows the text as it is; it is asked when that is drawn.
    if (file !== "" && !document.isUpToDate) return;
    const number = ++this.questions;
    const wanted = this.wanted(document.drawn);
    const found = await this.core
      .ask({ do: "chart", file, values: wanted.operands })
      .catch(() => null);
    if (number !== this.questions) return;
    // Moments have numbers of steps, not their names.
    if (wanted.names.join() !== this.asked.names.join()) this.trail.clear();
    this.asked = { ...wanted, id: found?.id ?? 0, reading: document.reading };
    this.take();
  }

  private wanted(drawn: Drawn | null): Omit<Asked, "id" | "reading"> {
    const sheets = drawn?.charts.sheets ?? [];
    const names = sheets.map(({ name, steps }) =>
      steps.map(({ fullName }) => keyOf(name, fullName)),
    );
    const known = new Map(this.operands.names.map((name) => [name.toLowerCase(), name]));
    const operands = new Map<string, number>();
    const numberOf = (name: string) => {
      if (!operands.has(name)) operands.set(name, operands.size);
      return operands.get(name) ?? 0;
    };
    const inConditions = new Map<string, number[]>();
    for (const item of drawn?.items ?? [])
      if (item.kind === "transition") {
        const found = item.element.operands.map((one) => nameIn(known, one));
        inConditions.set(
          item.key,
          found.map((name) => (name === undefined ? -1 : numberOf(name))),
        );
      }
    return { names, operands: [...operands.keys()], inConditions };
  }

  private take(): void {
    const { asked, told } = this;
    if (!told || told.id !== asked.id || asked.id === 0) return;
    this.trail.add(told.before, told, told.lost);
    this.told = { ...told, before: [], lost: false };
    if (this.trail.at === null) this.show();
    else this.tell();
  }

  /** The steps of all charts, named without the chart that is around all others. */
  get rows(): Row[] {
    const { names } = this.asked;
    const root = `${names[0]?.[0]?.split(" ")[0] ?? ""}.`;
    const nameOf = (key: string) => {
      const name = key.replace(" ", ".");
      return name.startsWith(root) ? name.slice(root.length) : name;
    };
    return names.flatMap((keys, chart) =>
      keys.map((key, step) => ({ name: nameOf(key), chart, step })),
    );
  }

  /** Goes along the trail. */
  go(move: (trail: Trail) => void): void {
    move(this.trail);
    this.show();
  }

  /** Shows the moment that is chosen. */
  private show(): void {
    const { trail, asked } = this;
    const { drawn } = this.document;
    const { shown, before } = trail;
    this.states = statesOf(asked, shown?.steps);
    this.times.clear();
    for (const [chart, steps] of asked.names.entries())
      for (const [step, key] of steps.entries()) {
        const lasting = trail.lasting(chart, step);
        if (lasting) this.times.set(key, `${lasting.isLeast ? "≥ " : ""}${seconds(lasting.ms)}`);
      }
    const was = statesOf(asked, before?.steps);
    const transitions = (drawn?.items ?? []).filter((item) => item.kind === "transition");
    const crossed = transitions.filter((item) => this.isBetween(item, was));
    this.crossed = new Set(crossed.map(({ key }) => key));
    const enabled = transitions.filter((item) => this.state(item));
    const valuesOf = ({ key }: TransitionItem) =>
      (asked.inConditions.get(key) ?? []).map((at) => shown?.values[at] ?? null);
    this.judging.judge(
      enabled.map((item) => ({ item, values: valuesOf(item) })),
      asked.reading,
    );
    this.tell();
  }

  private key({ sheet, element }: StepItem): string {
    return keyOf(this.document.drawn?.sheet(sheet)?.name ?? "", element.fullName);
  }

  private keys({ sheet }: Item, ids: ElementId[]): string[] {
    const steps = ids.map((id) => this.document.drawn?.at(sheet, id));
    return steps.flatMap((step) => (step?.kind === "step" ? this.key(step) : []));
  }

  /** Whether what is active has come from what was by way of a transition, as far as that can be
   * told. */
  private isBetween(item: TransitionItem, was: States): boolean {
    const [from, to] = [this.keys(item, item.element.from), this.keys(item, item.element.to)];
    const isLeft = from.every((key) => was.get(key) && !this.states.get(key));
    const isEntered = to.every((key) => this.states.get(key));
    return isLeft && isEntered && to.some((key) => was.get(key) === false);
  }

  /** Whether a step is active, and a transition enabled: all steps before it are active. */
  state(item: Item): boolean | null {
    if (item.kind === "step") return this.states.get(this.key(item)) ?? null;
    const states = this.keys(item, item.element.from).map((key) => this.states.get(key) ?? null);
    if (states.length === 0 || states.includes(null)) return null;
    return states.every(Boolean);
  }

  /** What is to be read beside an element. */
  note(item: Item): Note | null {
    if (item.kind === "step") {
      const time = this.times.get(this.key(item));
      return time === undefined ? null : timeOf(item.element, time);
    }
    const { drawn } = this.document;
    const judged = this.state(item) ? this.judging.of(item) : undefined;
    return judged && drawn ? noteOf(item.element, judged, roomFor(drawn, item)) : null;
  }

  /** Whether a transition led to the situation that is shown. */
  isCrossed({ key }: Item): boolean {
    return this.crossed.has(key);
  }

  /** Whether a step can be set by hand. */
  get canActivate(): boolean {
    const { status } = this;
    return status?.target === "simulator" && tellsOfProgram(status);
  }

  /** Makes a step of the simulator active, or inactive. */
  activate(item: StepItem): void {
    const step = `${this.document.drawn?.sheet(item.sheet)?.name ?? ""}.${item.element.fullName}`;
    this.core.tell({ do: "activate", step, on: !this.state(item) });
  }
}

function statesOf({ names }: Asked, steps: (boolean | null)[][] | undefined): States {
  const states: States = new Map();
  for (const [chart, keys] of names.entries())
    for (const [step, key] of keys.entries()) states.set(key, steps?.[chart]?.[step] ?? null);
  return states;
}

/** What an operand is called in the program. */
function nameIn(known: Map<string, string>, { written, names }: ChartOperand): string | undefined {
  if (written.startsWith("%")) return names[0];
  return names.map((name) => known.get(name.toLowerCase())).find((name) => name !== undefined);
}

/** Tells the steps of all charts of a file apart. */
const keyOf = (chart: string, step: string) => `${chart} ${step}`;

// Live values at the ends of lines, and power flow beside them.
import {
  RangeSet,
  RangeSetBuilder,
  StateEffect,
  StateField,
  type EditorState,
  type Transaction,
} from "@codemirror/state";
import {
  Decoration,
  EditorView,
  gutter,
  GutterMarker,
  WidgetType,
  type DecorationSet,
} from "@codemirror/view";
import type { Line, Value } from "../core/protocol";
import { h } from "../page/dom";
import { t } from "../text/language";

/** Values that were chosen, to set or force them; the menu is opened at `at`. */
export type Chosen = (value: Value, at: Element) => void;

interface Live {
  lines: Map<number, Line>;
  decorations: DecorationSet;
  flows: RangeSet<GutterMarker>;
}

const NONE: Live = { lines: new Map(), decorations: Decoration.none, flows: RangeSet.empty };

const setLines = StateEffect.define<Line[]>();

class Values extends WidgetType {
  constructor(
    readonly values: Value[],
    readonly chosen: Chosen,
  ) {
    super();
  }

  override eq(other: Values): boolean {
    const same = (value: Value, index: number) => {
      const before = other.values[index];
      return (
        value.name === before?.name && value.text === before.text && value.forced === before.forced
      );
    };
    return this.values.length === other.values.length && this.values.every(same);
  }

  override toDOM(): HTMLElement {
    const bits = this.values.filter(({ form }) => form === "bit");
    const values = this.values.map((value) => this.value(value, bits.length > 1));
    return h("span", { class: "live" }, ...values);
  }

  /** A bit that is alone in its line needs no name. */
  private value(value: Value, isNamed: boolean): HTMLElement {
    const isBit = value.form === "bit";
    const classes = ["value", isBit && "bit", value.number === 1 && "on", value.forced && "forced"];
    const text = isBit && !isNamed ? value.text : `${value.name} ${value.text || "?"}`;
    const element = h(
      "span",
      {
        class: classes.filter(Boolean).join(" "),
        attributes: { title: value.forced ? t("forcedValue", value.name) : value.name },
      },
      text || "?",
    );
    element.addEventListener("mousedown", (event) => {
      event.preventDefault();
      this.chosen(value, element);
    });
    return element;
  }

  override ignoreEvent(): boolean {
    return true;
  }
}

class Flow extends GutterMarker {
  constructor(readonly flow: string) {
    super();
  }

  override eq(other: Flow): boolean {
    return this.flow === other.flow;
  }

  override toDOM(): Node {
    return h("span", { class: `flow ${this.flow}` });
  }
}

const flows = new Map(["on", "off", "skipped"].map((flow) => [flow, new Flow(flow)]));

function shown(state: EditorState, lines: Line[], chosen: Chosen): Live {
  const decorations = new RangeSetBuilder<Decoration>();
  const markers = new RangeSetBuilder<GutterMarker>();
  const there = lines.filter(({ line }) => line <= state.doc.lines);
  for (const { line, values, flow } of there.sort((a, b) => a.line - b.line)) {
    const { from, to } = state.doc.line(line);
    const widget = new Values(values, chosen);
    if (values.length > 0) decorations.add(to, to, Decoration.widget({ widget, side: 1 }));
    const marker = flows.get(flow ?? "");
    if (marker) markers.add(from, from, marker);
  }
  const byLine = new Map(there.map((line) => [line.line, line]));
  return { lines: byLine, decorations: decorations.finish(), flows: markers.finish() };
}

/** Until new values come the old ones stay beside their lines while these move. */
function moved(live: Live, { changes }: Transaction): Live {
  return {
    lines: live.lines,
    decorations: live.decorations.map(changes),
    flows: live.flows.map(changes),
  };
}

function field(chosen: Chosen): StateField<Live> {
  return StateField.define<Live>({
    create: () => NONE,
    update(live, transaction) {
      let now = transaction.docChanged ? moved(live, transaction) : live;
      for (const effect of transaction.effects)
        if (effect.is(setLines)) now = shown(transaction.state, effect.value, chosen);
      return now;
    },
    provide: (field) => EditorView.decorations.from(field, (live) => live.decorations),
  });
}

/** Live values in an editor. One for all files: what is in it is a file's own. */
export class LiveValues {
  private readonly field: StateField<Live>;
  readonly extension;

  constructor(chosen: Chosen) {
    this.field = field(chosen);
    this.extension = [
      this.field,
      gutter({
        class: "flow-gutter",
        markers: (view) => view.state.field(this.field).flows,
        initialSpacer: () => new Flow("off"),
      }),
    ];
  }

  /** Shows these lines and no others. */
  show(view: EditorView, lines: Line[]): void {
    const known = view.state.field(this.field, false);
    if (known && (lines.length > 0 || known.lines.size > 0))
      view.dispatch({ effects: setLines.of(lines) });
  }

  /** The values of the line with the cursor. */
  atCursor(view: EditorView): Value[] {
    const line = view.state.doc.lineAt(view.state.selection.main.head).number;
    return view.state.field(this.field, false)?.lines.get(line)?.values ?? [];
  }
}

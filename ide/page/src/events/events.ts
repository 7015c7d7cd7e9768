// A block of IEC 61499 in the page: its chart with the state that it is in, events that can be sent,
// values that can be set, and what came of it.
import type { Editors } from "../editor/editors";
import { button, h, iconButton, say } from "../page/dom";
import { icon } from "../page/icons";
import { notice } from "../page/notices";
import type { Project } from "../project/project";
import { EVENT_WORDS } from "../text/event_words";
import { addWords, onLanguage } from "../text/language";
import { Obstacle, zoomButtons } from "../drawings/parts";
import { EventsDocument, type Shown } from "./document";
import { Picture } from "./picture";
import type { BlockEvent, BlockValue, Events } from "./protocol";
import { valuesTable } from "./values";

addWords(EVENT_WORDS);

export class EventsView {
  private document: EventsDocument;
  private picture = new Picture();
  private obstacle = new Obstacle((line) => this.document.goTo(line));
  private tools = h("div", { class: "tools", attributes: { role: "toolbar" } });
  private stage = h("div", { class: "stage" }, this.picture.element);
  private send = h("div", { class: "controls", attributes: { role: "group" } });
  private values = h("div", { class: "event-values" });
  private log = h("ol", { class: "event-log", attributes: { role: "log", tabindex: 0 } });
  private drawn: Shown = null;

  constructor(element: HTMLElement, editors: Editors, project: Project) {
    this.document = new EventsDocument(editors, project, (shown, isOther) =>
      this.take(shown, isOther),
    );
    say(this.tools, "aria-label", "eventsTools");
    say(this.send, "aria-label", "eventsSend");
    say(this.log, "aria-label", "eventsLog");
    this.tools.append(
      button("eventsAnew", () => this.document.takeBack(true)),
      iconButton(icon("undo"), "eventsBack", () => this.document.takeBack(false)),
      ...zoomButtons(this.picture),
    );
    element.append(this.tools, this.obstacle.element, this.stage, this.send, this.values, this.log);
    onLanguage(() => this.draw());
    this.draw();
  }

  shown(isShown: boolean): void {
    this.document.shown(isShown);
  }

  private take(shown: Shown, isOther: boolean): void {
    this.drawn = shown;
    this.draw();
    const events = this.events;
    if (!events) return;
    if (isOther) this.picture.begin();
    this.picture.show(events.states[events.state]);
  }

  private get events(): Events | null {
    const { drawn } = this;
    return drawn && "events" in drawn && !drawn.events.mistake ? drawn.events : null;
  }

  private draw(): void {
    const { drawn, events } = this;
    for (const part of [this.tools, this.stage, this.send, this.values, this.log])
      part.hidden = events === null;
    const mistake = drawn && "events" in drawn ? drawn.events.mistake : null;
    const words = drawn && "refused" in drawn ? drawn.refused : (mistake?.message ?? "");
    this.obstacle.show(words, mistake?.line);
    if (events) this.drawBlock(events);
  }

  private drawBlock(events: Events): void {
    const focus = document.activeElement?.getAttribute("data-of");
    this.picture.draw(events);
    this.send.replaceChildren(...events.eventInputs.map((one) => this.sender(one)));
    const { inputs, outputs, internals } = events;
    this.values.replaceChildren(
      valuesTable("eventsInputs", inputs, (one, text) => this.set(one, text)),
      valuesTable("eventsOutputs", outputs),
      valuesTable("eventsInternals", internals),
    );
    const said = events.told.map(({ text, isWrong }, at) =>
      h("li", { class: isWrong ? "bad" : "" }, text || (this.document.lines[at] ?? "")),
    );
    this.log.replaceChildren(...said);
    this.log.scrollTop = this.log.scrollHeight;
    if (focus) this.focusOn(focus);
  }

  /** What had the focus before all was drawn anew. */
  private focusOn(of: string): void {
    const fields = [...this.send.children, ...this.values.querySelectorAll("[data-of]")];
    const found = fields.find((one) => one.getAttribute("data-of") === of);
    if (found instanceof HTMLElement) found.focus();
  }

  private sender({ name, comment, with: variables }: BlockEvent): HTMLElement {
    const title = [comment, variables.join(", ")].filter(Boolean).join(": ");
    const act = () => void this.add(`event ${name}`);
    const attributes = { type: "button", title: title || undefined, "data-of": `event ${name}` };
    return h("button", { class: "primary", attributes, on: { click: act } }, name);
  }

  private set({ name }: BlockValue, value: string): Promise<boolean> {
    return this.add(`${name} = ${value}`);
  }

  /** Whether it could be done; why not is told. */
  private async add(line: string): Promise<boolean> {
    const wrong = await this.document.add(line);
    if (wrong !== null) notice(wrong, true);
    return wrong === null;
  }
}

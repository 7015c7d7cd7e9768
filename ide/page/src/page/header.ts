// The head of the page: what the program runs on, what it is to do, and how it is.
import type { Core } from "../core/core";
import type { Status, TargetKind } from "../core/protocol";
import { onLanguage, t, type Key } from "../text/language";
import { button, h, iconButton, say, select } from "./dom";
import { icon, type Icon } from "./icons";
import { closeNotices, notice } from "./notices";

const TARGETS = [
  ["simulator", "simulator"],
  ["virtualUno", "virtualUno"],
  ["usb", "unoOnUsb"],
  ["bridge", "bridge"],
] as const;

/** How fast the time of a target in the page goes. */
const SPEEDS = [
  ["0.01", { plain: "1/100 ×" }],
  ["0.1", { plain: "1/10 ×" }],
  ["1", "realTime"],
  ["10", { plain: "10 ×" }],
  ["100", { plain: "100 ×" }],
  ["0", "asFastAsItCan"],
] as const;

export type Action = "run" | "stop" | "pause" | "singleScan" | "reset" | "download" | "connect";

/** Buttons, in their order, each with its words and its shortcut. */
const ACTIONS: { action: Action; text: Key; icon: Icon; hint: string }[] = [
  { action: "run", text: "run", icon: "run", hint: "F9" },
  { action: "stop", text: "stop", icon: "stop", hint: "Shift+F9" },
  { action: "pause", text: "pause", icon: "pause", hint: "Ctrl+F9" },
  { action: "singleScan", text: "singleScan", icon: "step", hint: "F10" },
  { action: "reset", text: "reset", icon: "reset", hint: "" },
  { action: "download", text: "download", icon: "download", hint: "" },
  { action: "connect", text: "connect", icon: "connect", hint: "" },
];

export interface Menus {
  project(at: Element): void;
  settings(): void;
  help(): void;
  /** Shows or hides the list of files where there is no room for it. */
  files(): void;
}

/** Does something when no project is being opened any more. */
export type Afterwards = (act: () => void) => void;

export class Header {
  readonly element: HTMLElement;
  /** What the target said last. */
  status: Status | undefined;
  private state = h("div", { class: "state", attributes: { role: "status" } });
  private target: HTMLSelectElement;
  private speed: HTMLSelectElement;
  private buttons = new Map<Action, HTMLButtonElement>();
  private listeners: ((status: Status) => void)[] = [];
  private runListeners: (() => void)[] = [];

  constructor(
    private core: Core,
    menus: Menus,
    private afterwards: Afterwards,
  ) {
    this.target = select("target", TARGETS, "simulator", (kind) => this.setTarget(kind));
    this.speed = select("speed", SPEEDS, "1", (factor) =>
      core.tell({ do: "speed", factor: Number(factor) }),
    );
    for (const { action, text, icon: picture, hint } of ACTIONS) {
      const element = button(text, () => this.act(action), { icon: icon(picture), class: action });
      say(element, "aria-label", text);
      if (hint) {
        element.setAttribute("aria-keyshortcuts", hint.replace("Ctrl", "Control"));
        element.dataset["hint"] = hint;
      }
      this.buttons.set(action, element);
    }
    this.element = this.layOut(menus);
    core.on("status", ({ status }) => this.show(status));
    core.onRefused((what, message) => {
      notice(message, true);
      if (what === "target" && this.status) this.target.value = this.status.target;
    });
    onLanguage(() => this.status && this.show(this.status));
    this.show({
      target: "simulator",
      mode: "OFFLINE",
      loading: null,
      agreement: "none",
      scans: 0,
      timeMs: 0,
      pace: null,
      scanUs: null,
      fault: null,
      faultAt: null,
      lost: null,
    });
  }

  private layOut(menus: Menus): HTMLElement {
    const project = button("project", () => menus.project(project));
    project.setAttribute("aria-haspopup", "menu");
    project.setAttribute("aria-expanded", "false");
    const files = iconButton(icon("menu"), "showFiles", menus.files);
    files.classList.add("files-switch");
    return h(
      "header",
      {},
      h("div", { class: "group name" }, files, h("h1", {}, "uno200"), project),
      h("div", { class: "group aim" }, this.target, this.speed),
      h(
        "div",
        { class: "group actions", label: "control", attributes: { role: "group" } },
        ...this.buttons.values(),
      ),
      this.state,
      h(
        "div",
        { class: "group end" },
        iconButton(icon("settings"), "settings", menus.settings),
        iconButton(icon("help"), "help", menus.help),
      ),
    );
  }

  private setTarget(kind: TargetKind): void {
    this.afterwards(() => this.core.tell({ do: "target", kind }));
  }

  /** Does what a button does. */
  act(action: Action): void {
    this.afterwards(() => this.tell(action));
  }

  private tell(action: Action): void {
    const { core } = this;
    core.beforeQuestion();
    // What went wrong before may be mended now.
    closeNotices();
    if (action === "run") for (const listener of this.runListeners) listener();
    const mode = this.status?.mode ?? "OFFLINE";
    if (action === "pause") core.tell({ do: "pause", on: mode !== "PAUSE" });
    else if (action === "connect") core.tell({ do: isConnected(mode) ? "disconnect" : "connect" });
    else core.tell({ do: action });
  }

  /** Is told that the program is to run. */
  onRun(listener: () => void): void {
    this.runListeners.push(listener);
  }

  /** Is told how the target is. */
  onStatus(listener: (status: Status) => void): void {
    this.listeners.push(listener);
  }

  private show(status: Status): void {
    this.status = status;
    this.target.value = status.target;
    // Its place stays: a button that moves under a finger is not pressed.
    this.speed.classList.toggle("unseen", !isInPage(status.target));
    this.press("pause", status.mode === "PAUSE");
    this.press("connect", isConnected(status.mode));
    const mode = h("strong", { class: `mode ${status.mode.toLowerCase()}` }, status.mode);
    const words = statusWords(status);
    // Readers of screens are told a mode once, not each scan time.
    const times = h("span", { class: "times", attributes: { "aria-live": "off" } }, words);
    this.state.replaceChildren(mode, times);
    this.state.title = words;
    for (const listener of this.listeners) listener(status);
  }

  private press(action: Action, isOn: boolean): void {
    this.buttons.get(action)?.setAttribute("aria-pressed", String(isOn));
  }
}

/** Whether its time is the page's. */
function isInPage(target: TargetKind): boolean {
  return target === "simulator" || target === "virtualUno";
}

/** Whether it has the program of the page, and tells what that does. */
export function tellsOfProgram({ mode, agreement }: Status): boolean {
  const isThis = agreement === "same" || agreement === "native";
  return isThis && isConnected(mode);
}

function isConnected(mode: string): boolean {
  return mode !== "OFFLINE" && mode !== "LOST";
}

/** Scan time, scans, and what is wrong, in words. */
export function statusWords(status: Status): string {
  if (status.loading) return loadingWords(status.loading);
  const words: string[] = [];
  if (status.scanUs) {
    const [least, last, most] = status.scanUs.map(microseconds);
    words.push(t("scanTime", last ?? "", least ?? "", most ?? ""));
  }
  if (status.mode !== "OFFLINE") words.push(t("scansDone", status.scans.toLocaleString()));
  if (isInPage(status.target) && status.mode !== "OFFLINE")
    words.push(`${(status.timeMs / 1000).toFixed(1)} s`);
  if (status.pace !== null) words.push(t("pace", status.pace.toFixed(2)));
  if (status.agreement === "other") words.push(t("otherProgram"));
  if (status.fault) words.push(t("fault", status.fault));
  if (status.lost) words.push(t("linkLost", status.lost));
  return words.join(" · ");
}

/** How far the writing of a board is, in words. */
function loadingWords({ phase, percent }: NonNullable<Status["loading"]>): string {
  switch (phase) {
    case "writing":
      return t("loadingWriting", percent);
    case "verifying":
      return t("loadingVerifying", percent);
    case "starting":
      return t("loadingStarting");
    default:
      return t("loadingConnecting");
  }
}

function microseconds(us: number): string {
  if (us >= 10_000) return `${(us / 1000).toFixed(1)} ms`;
  return us >= 100 ? `${us.toFixed(0)} µs` : `${us.toFixed(1)} µs`;
}

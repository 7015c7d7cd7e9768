// Asks for live values of the lines that can be seen, and shows them.
import type { Core } from "../core/core";
import type { Line } from "../core/protocol";
import type { Editors } from "../editor/editors";
import type { Project } from "../project/project";
import type { Ladder } from "../panels/ladder";
import type { Header } from "./header";

/** So long nothing is asked for while a text is being scrolled. */
const QUIET_MS = 80;

export class LiveView {
  private timer = 0;
  private asked = "";
  private lines: Line[] = [];

  constructor(
    private core: Core,
    private project: Project,
    private editors: Editors,
    private ladder: Ladder,
    header: Header,
  ) {
    core.on("live", ({ lines }) => {
      this.lines = lines;
      this.show();
    });
    header.onStatus((status) => {
      editors.element.classList.toggle("stale", status.mode === "LOST");
      const isThis = status.agreement === "same" || status.agreement === "native";
      if (!isThis || status.mode === "OFFLINE") this.clear();
    });
    editors.onView(() => this.soon());
    ladder.onNeeded(() => this.soon());
    project.onFiles(() => this.soon());
    project.onOpened(() => this.clear());
    document.addEventListener("visibilitychange", () => this.soon());
  }

  private show(): void {
    this.editors.showLive(this.project.main(), this.lines);
  }

  private clear(): void {
    if (this.lines.length === 0) return;
    this.lines = [];
    this.show();
  }

  private soon(): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.ask(), QUIET_MS);
  }

  private ask(): void {
    const { from, to } = this.visible();
    const wanted = `${from}-${to}`;
    if (wanted === this.asked) return;
    this.asked = wanted;
    this.core.tell({ do: "view", from, to });
  }

  private visible(): { from: number; to: number } {
    const main = this.project.main();
    const view = main === null ? undefined : this.editors.viewOf(main);
    if (!view || document.hidden) return { from: 0, to: 0 };
    const { from, to } = view.viewport;
    const { doc } = view.state;
    const lines = { from: doc.lineAt(from).number, to: doc.lineAt(to).number };
    const ladder = this.ladder.needed() ?? lines;
    return { from: Math.min(lines.from, ladder.from), to: Math.max(lines.to, ladder.to) };
  }
}

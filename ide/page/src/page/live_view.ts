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
  /** The files of the program that was assembled last. */
  files: string[] = [];
  private file = "";
  private lines: Line[] = [];

  constructor(
    private core: Core,
    private project: Project,
    private editors: Editors,
    private ladder: Ladder,
    header: Header,
  ) {
    core.on("live", ({ file, lines }) => {
      [this.file, this.lines] = [file, lines];
      this.show();
    });
    core.on("program", ({ program }) => {
      this.files = program?.files ?? this.files;
      this.soon();
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
    this.editors.showLive(this.file, this.lines);
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
    const wanted = this.visible();
    const asked = JSON.stringify(wanted);
    if (asked === this.asked) return;
    this.asked = asked;
    this.core.tell({ do: "view", ...wanted });
  }

  /** The lines of the file that is worked on, else of the main one, and those of the ladder. */
  private visible(): { file: string; from: number; to: number } {
    const ladder = this.ladder.needed();
    const { current } = this.editors;
    const file = this.files.find((file) => file === current) ?? this.project.main() ?? "";
    const view = this.editors.viewOf(file);
    if (!view || document.hidden) return { file, from: 0, to: 0 };
    const { from, to } = view.viewport;
    const { doc } = view.state;
    const lines = { file, from: doc.lineAt(from).number, to: doc.lineAt(to).number };
    if (ladder?.file !== file) return lines;
    const [first, last] = ladder.lines;
    return { file, from: Math.min(lines.from, first), to: Math.max(lines.to, last) };
  }
}

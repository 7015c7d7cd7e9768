// The charts of the file in the editor. What draws and edits them is loaded when they are looked at
// for the first time.
import type { ChartEditor } from "../chart/editor";
import type { Core } from "../core/core";
import type { Editors } from "../editor/editors";
import { h } from "../page/dom";
import type { Header } from "../page/header";
import { notice } from "../page/notices";
import type { Project } from "../project/project";
import { t } from "../text/language";
import type { Operands } from "./operands";

export class Chart {
  readonly element = h("div", { class: "chart" });
  private editor: Promise<ChartEditor> | undefined;

  constructor(
    private core: Core,
    private editors: Editors,
    private project: Project,
    private header: Header,
    private operands: Operands,
  ) {}

  /** Charts are drawn only while they can be seen. */
  shown(isShown: boolean): void {
    if (isShown) this.editor ??= this.load();
    this.editor?.then(
      (editor) => editor.shown(isShown),
      (error: unknown) => {
        this.editor = undefined;
        notice(t("chartBroken", String(error)), true);
      },
    );
  }

  private async load(): Promise<ChartEditor> {
    const { ChartEditor } = await import("../chart/editor");
    const { element, core, editors, project, header, operands } = this;
    return new ChartEditor(element, core, editors, project, header, operands);
  }
}

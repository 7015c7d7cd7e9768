// A panel whose contents are loaded when it is looked at for the first time.
import { h } from "../page/dom";
import { notice } from "../page/notices";
import { t } from "../text/language";

/** What fills it. */
interface Contents {
  /** Something is done only while it can be seen. */
  shown(isShown: boolean): void;
}

export class Lazy {
  readonly element: HTMLElement;
  private contents: Promise<Contents> | undefined;

  constructor(
    name: string,
    private load: (element: HTMLElement) => Promise<Contents>,
  ) {
    this.element = h("div", { class: name });
  }

  shown(isShown: boolean): void {
    if (isShown) this.contents ??= this.load(this.element);
    this.contents?.then(
      (contents) => contents.shown(isShown),
      (error: unknown) => {
        this.contents = undefined;
        notice(t("drawingBroken", String(error)), true);
      },
    );
  }
}

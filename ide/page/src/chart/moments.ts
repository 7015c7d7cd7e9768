// The bar with which a person goes along the moments of a chart, and what is said when the target has
// another program.
import { button, h, iconButton } from "../page/dom";
import type { Header } from "../page/header";
import { icon } from "../page/icons";
import { onLanguage, t } from "../text/language";
import type { Live } from "./live";

export class Moments {
  private words = h("output", { class: "hint", attributes: { "aria-live": "off" } });
  private slider = h("input", {
    label: "chartMoment",
    attributes: { type: "range", min: 0, step: 1 },
    on: { input: () => this.live.go((trail) => trail.goTo(Number(this.slider.value))) },
  });
  private back = iconButton(icon("back"), "chartMomentBack", () => this.go(-1));
  private forward = iconButton(icon("run"), "chartMomentForward", () => this.go(1));
  private latest = button("chartMomentNow", () => this.now());
  private bar = h(
    "div",
    { class: "moments", label: "chartMoments", attributes: { role: "group" } },
    this.back,
    this.slider,
    this.forward,
    this.latest,
    button("chartOneScan", () => this.oneScan(), {}),
    this.words,
  );
  private other = h(
    "p",
    { class: "obstacle" },
    h("span", { text: "chartOther", attributes: { role: "status" } }),
    " ",
    button("chartLoadAnew", () => this.header.act("download")),
  );
  readonly element = h("div", { class: "chart-head" }, this.other, this.bar);

  constructor(
    private live: Live,
    private header: Header,
  ) {
    live.onChange(() => this.show());
    onLanguage(() => this.show());
    this.show();
  }

  /** Goes to the next moment, or the one before. */
  go(by: 1 | -1): void {
    this.live.go((trail) => trail.go(by));
  }

  now(): void {
    this.live.go((trail) => trail.goTo(-1));
  }

  /** Has the target execute one scan, which is shown. */
  oneScan(): void {
    this.now();
    this.header.act("singleScan");
  }

  private show(): void {
    const { trail, hasOther } = this.live;
    const { moments, at, shown } = trail;
    this.other.hidden = !hasOther;
    this.bar.hidden = moments.length === 0;
    if (!shown) return;
    const count = moments.length;
    this.slider.max = String(count);
    this.slider.value = String(at ?? count);
    const time = (shown.timeMs / 1000).toFixed(3);
    const told =
      at === null
        ? t("chartNowOf", time, shown.scan, count)
        : t("chartMomentOf", time, shown.scan, at + 1, count);
    const lost = trail.losses > 0 ? t("chartMomentsLost") : "";
    this.words.textContent = [told, lost].filter(Boolean).join(" · ");
    this.slider.setAttribute("aria-valuetext", told);
    this.back.setAttribute("aria-disabled", String(!trail.canGo(-1)));
    this.forward.setAttribute("aria-disabled", String(!trail.canGo(1)));
    this.latest.setAttribute("aria-disabled", String(at === null));
  }
}

// Short messages that go away by themselves; bad ones stay until they are closed.
import { h, iconButton } from "./dom";
import { icon } from "./icons";

const SHOWN_MS = 6000;
const COUNT_MAX = 4;

const polite = h("div", { class: "notices", attributes: { "aria-live": "polite" } });

/** Where notices appear. */
export function noticeArea(): HTMLElement {
  return polite;
}

/** What was told is over. */
export function closeNotices(): void {
  polite.replaceChildren();
}

/** Tells something. */
export function notice(message: string, bad = false): void {
  const same = [...polite.children].find((one) => one.firstChild?.textContent === message);
  same?.remove();
  const element = h(
    "div",
    { class: bad ? "notice bad" : "notice", attributes: { role: bad ? "alert" : undefined } },
    h("span", {}, message),
  );
  element.append(iconButton(icon("close"), "closeNotice", () => element.remove()));
  polite.append(element);
  while (polite.childElementCount > COUNT_MAX) polite.firstElementChild?.remove();
  if (!bad) setTimeout(() => element.remove(), SHOWN_MS);
}

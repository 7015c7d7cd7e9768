// A button that is on as long as it is held, by pointer or by key; a tap is long enough for a PLC to
// see it.

/** So long it is on at least. */
const LEAST_MS = 100;

/** Tells when the button is pressed and when it is let go. */
export function hold(push: HTMLElement, changed: (isDown: boolean) => void): void {
  let since = 0;
  let timer = 0;
  const set = (isDown: boolean) => {
    window.clearTimeout(timer);
    if (push.classList.contains("down") === isDown) return;
    const rest = isDown ? 0 : since + LEAST_MS - performance.now();
    if (rest > 0) {
      timer = window.setTimeout(() => set(false), rest);
      return;
    }
    if (isDown) since = performance.now();
    push.classList.toggle("down", isDown);
    changed(isDown);
  };
  push.addEventListener("pointerdown", (event) => {
    push.setPointerCapture(event.pointerId);
    set(true);
  });
  for (const end of ["pointerup", "pointercancel", "blur"])
    push.addEventListener(end, () => set(false));
  push.addEventListener("keydown", (event) => {
    if (event.key !== " " && event.key !== "Enter") return;
    event.preventDefault();
    set(true);
  });
  push.addEventListener("keyup", () => set(false));
}

// A button that is on as long as it is held, by pointer or by key.

/** Tells when the button is pressed and when it is let go. */
export function hold(push: HTMLElement, changed: (isDown: boolean) => void): void {
  const set = (isDown: boolean) => {
    if (push.classList.contains("down") === isDown) return;
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

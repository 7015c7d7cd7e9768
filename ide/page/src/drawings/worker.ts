// The worker that draws charts and diagrams, and edits charts: passes questions on to the module,
// posts answers.
import init, { Drawings } from "./ide_drawings.js";

/** What is used of a worker's surroundings; the page's types have another `self`. */
interface Surroundings {
  onmessage: ((message: MessageEvent<string>) => void) | null;
  postMessage(answer: string | { broken: string }): void;
}
const surroundings = self as unknown as Surroundings;

let drawings: Drawings | undefined;
const early: string[] = [];

/** What the module does not survive ends it: its state cannot be trusted any more. */
function take(question: string): void {
  try {
    if (drawings) surroundings.postMessage(drawings.request(question));
    else early.push(question);
  } catch (error) {
    drawings = undefined;
    surroundings.postMessage({ broken: String(error) });
  }
}

surroundings.onmessage = ({ data }) => take(data);

init({ module_or_path: new URL("ide_drawings_bg.wasm", import.meta.url) }).then(
  () => {
    drawings = new Drawings();
    early.splice(0).forEach(take);
  },
  (error: unknown) => surroundings.postMessage({ broken: String(error) }),
);

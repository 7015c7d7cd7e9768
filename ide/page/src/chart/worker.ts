// The worker that draws charts and edits them: passes questions on to the module, posts answers.
import init, { Charts } from "./ide_charts.js";

/** What is used of a worker's surroundings; the page's types have another `self`. */
interface Surroundings {
  onmessage: ((message: MessageEvent<string>) => void) | null;
  postMessage(answer: string | { broken: string }): void;
}
const surroundings = self as unknown as Surroundings;

let charts: Charts | undefined;
const early: string[] = [];

/** What the module does not survive ends it: its state cannot be trusted any more. */
function take(question: string): void {
  try {
    if (charts) surroundings.postMessage(charts.request(question));
    else early.push(question);
  } catch (error) {
    charts = undefined;
    surroundings.postMessage({ broken: String(error) });
  }
}

surroundings.onmessage = ({ data }) => take(data);

init({ module_or_path: new URL("ide_charts_bg.wasm", import.meta.url) }).then(
  () => {
    charts = new Charts();
    early.splice(0).forEach(take);
  },
  (error: unknown) => surroundings.postMessage({ broken: String(error) }),
);

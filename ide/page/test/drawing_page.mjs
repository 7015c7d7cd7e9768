// What tests of drawings have in common: texts, and a page that shows them.
import { deflateSync } from "fflate";

export const file = (name, text = "") => ({ name, text });

/** A project in the address, with the panel of charts, or another one. */
export async function load(page, address, ...files) {
  return loadIn("chart", page, address, ...files);
}

export async function loadIn(view, page, address, ...files) {
  const content = { files, main: files[0].name, plant: null, view };
  const part = Buffer.from(deflateSync(Buffer.from(JSON.stringify(content)))).toString("base64url");
  await page.goto("about:blank");
  await page.goto(`${address.replace(/\?.*/, "")}#project=${part}`);
  await page.getByRole("textbox", { name: files[0].name }).waitFor();
}

/** A chart of so many steps in a row, in the layout of the tools. */
export function chain(count) {
  const names = Array.from({ length: count }, (_, at) => `S${at + 1}`);
  const steps = names.map((name, at) => `${at === 0 ? "INITIAL_" : ""}STEP ${name}:\nEND_STEP\n`);
  const ways = names
    .slice(1)
    .map((name, at) => `TRANSITION FROM ${names[at]} TO ${name} := TRUE;\nEND_TRANSITION\n`);
  return [...steps, ...ways].join("\n");
}

/** Has a page keep what the core told last of active steps, and was told last of texts. */
export async function listen(page) {
  await page.addInitScript(() => {
    const Real = Worker;
    globalThis.told = [];
    globalThis.texts = {};
    globalThis.Worker = class extends Real {
      constructor(...given) {
        super(...given);
        this.addEventListener("message", ({ data }) => {
          for (const event of Array.isArray(data) ? data : [])
            if (event.is === "situation") globalThis.told = event.steps;
        });
      }
      postMessage(wish) {
        super.postMessage(wish);
        const told = typeof wish === "string" ? JSON.parse(wish) : {};
        if (told.do === "open")
          for (const { name, text } of told.files) globalThis.texts[name] = text;
        if (told.do === "edit" && told.file) globalThis.texts[told.file] = told.text;
      }
    };
  });
}

/** Waits until an output of an element of a diagram has a value within bounds. */
export async function output(page, name, pin, least, most) {
  await page.waitForFunction(
    ({ name, pin, least, most }) => {
      const all = [...document.querySelectorAll(".diagram .element [role=button]")];
      const said = all.map((one) => one.getAttribute("aria-label")).find((one) => name.test(one));
      const [, value] = new RegExp(`, ${pin} (\\S+?)(,|$)`).exec(said ?? "") ?? [];
      return value !== undefined && Number(value) >= least && Number(value) <= most;
    },
    { name, pin, least, most },
  );
}

/** The middle of what is drawn. */
export async function middle(node) {
  const { x, y, width, height } = await node.boundingBox();
  return [x + width / 2, y + height / 2];
}

/** The tasks of a page that are longer than 50 ms while something is done, in ms, and how many there
 * are in all. The time is that which the page had the processor; what other programs take is not in
 * it. */
export async function longTasks(browser, page, act) {
  await browser.startTracing(page, { categories: ["toplevel", "__metadata", "blink.user_timing"] });
  await page.evaluate(() => performance.mark("traced"));
  await act();
  const { traceEvents } = JSON.parse((await browser.stopTracing()).toString());
  const { pid, tid } = traceEvents.find(({ name }) => name === "traced");
  const tasks = traceEvents.filter(
    (event) => event.pid === pid && event.tid === tid && /RunTask$/.test(event.name),
  );
  const long = tasks.filter(({ tdur }) => tdur > 50_000);
  return { long: long.map(({ tdur }) => Math.round(tdur / 1000)), count: tasks.length };
}

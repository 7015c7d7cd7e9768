// The page: makes its parts, connects them, opens the project.
import { EditorView } from "@codemirror/view";
import "./css/page.css";
import { Core } from "./core/core";
import { Watching } from "./core/watching";
import { Commands } from "./editor/commands";
import { Editors } from "./editor/editors";
import { LiveView } from "./page/live_view";
import { h } from "./page/dom";
import { Header } from "./page/header";
import { help, settings } from "./page/help";
import { shortcuts } from "./page/shortcuts";
import { noticeArea, notice } from "./page/notices";
import { ProjectMenu } from "./page/project_menu";
import { Sidebar } from "./page/sidebar";
import { separator } from "./page/split";
import { Tabs } from "./page/tabs";
import { unfitWords } from "./page/unfit";
import { valueMenu, valuesMenu } from "./page/values";
import { Capture } from "./panels/capture";
import { Exercises } from "./panels/exercises";
import { Ladder } from "./panels/ladder";
import { ByFile } from "./panels/by_file";
import { Lazy } from "./panels/lazy";
import { Operands } from "./panels/operands";
import { Plant } from "./panels/plant";
import { Problems } from "./panels/problems";
import { Scope } from "./panels/scope";
import { Tests } from "./panels/tests";
import { Watch } from "./panels/watch";
import { keepOffline } from "./offline/register";
import { diskTalk } from "./page/disk_talk";
import { Bridge } from "./ports/bridge";
import { Outside, words } from "./ports/outside";
import { fragmentFor, fromAddress, lastOrBlink, type Opened } from "./project/begin";
import { Chosen } from "./project/chosen";
import { Disk } from "./project/disk";
import { Opening } from "./project/opening";
import { isProgram, Project, Unfit } from "./project/project";
import { Keeper, lastId } from "./project/storage";
import { confirm } from "./page/dialog";
import { language, t } from "./text/language";

document.documentElement.lang = language();

const core = new Core((message) => notice(t("coreBroken", message), true));
const project = new Project(core);
const keeper = new Keeper(project, () => notice(t("storageFull"), true));
const operands = new Operands(core);
const watching = new Watching(core);
const bridge = Bridge.fromAddress();
let current = { id: "", title: "" };

const place = h("div", { class: "editors" });
const commands: Commands = new Commands(
  core,
  project,
  () => editors,
  (title, places) => {
    showFiles(true);
    sidebar.showFound(title, places);
  },
  () => chooseValue(),
);
const editors: Editors = new Editors(place, core, project, {
  chosen: (value, at) => valueMenu(core, value, at),
  explain: (code) => void commands.explain(code),
  renameFile: (file) => void sidebar.renameFile(file),
  keys: commands.keys,
});
place.addEventListener("mousedown", (event) => commands.click(event, editors.view));

const sidebar = new Sidebar(core, project, editors, (text) => commands.search(text));
const problems = new Problems(
  core,
  editors,
  (code) => void commands.explain(code),
  () => tabs,
);
const chosen = new Chosen(project, () => current);
const watch: Watch = new Watch(core, watching, editors, operands, chosen, () => tabs);
const scope = new Scope(core, operands, chosen);
const capture = new Capture(core, project, operands, chosen);
const plant = new Plant(core, project);
const tests = new Tests(core, project, editors, () => tabs);
const opening = new Opening(take);
const exercises = new Exercises(core, project, opening.open, () => current);
const disk =
  bridge && new Disk(bridge, project, (file, text) => editors.replace(file, text), diskTalk);
const menu = new ProjectMenu(
  project,
  opening.open,
  () => current,
  () => (bridge?.hasFolder ? disk : null),
);
const menus = {
  project: (at: Element) => menu.show(at),
  settings,
  help,
  files: () => showFiles(sidebar.element.classList.contains("away")),
};
const header = new Header(core, menus, (act) => opening.afterwards(act));
const ladder = new Ladder(core, editors, project, header);
const chart = new Lazy("chart", async (element) => {
  const { ChartEditor } = await import("./chart/editor");
  return new ChartEditor(element, core, editors, project, header, operands);
});
const events = new Lazy("events", async (element) => {
  const { EventsView } = await import("./events/events");
  return new EventsView(element, editors, project);
});
const charts = new ByFile(editors, chart, { files: /\.fbt$/i, contents: events });
const diagram = new Lazy("diagram", async (element) => {
  const { DiagramView } = await import("./diagram/diagram");
  const plot = (operand: string) => {
    scope.add(operand);
    tabs.show("scope", true);
  };
  const helps = { plot, rename: (file: string, at: number) => commands.rename({ file, at }) };
  return new DiagramView(element, core, editors, project, header, operands, watching, helps);
});
const tabs: Tabs = new Tabs("panels", [
  { id: "problems", text: "problems", element: problems.element },
  { id: "watch", text: "watch", element: watch.element, shown: (shown) => watch.shown(shown) },
  {
    id: "scope",
    text: "oscilloscope",
    element: scope.element,
    shown: (shown) => scope.shown(shown),
  },
  {
    id: "capture",
    text: "capture",
    element: capture.element,
    shown: (shown) => capture.shown(shown),
  },
  { id: "plant", text: "plant", element: plant.element },
  { id: "tests", text: "tests", element: tests.element },
  {
    id: "ladder",
    text: "ladder",
    element: ladder.element,
    shown: (shown) => ladder.shown(shown),
  },
  { id: "chart", text: "chart", element: charts.element, shown: (shown) => charts.shown(shown) },
  {
    id: "diagram",
    text: "diagram",
    element: diagram.element,
    shown: (shown) => diagram.shown(shown),
  },
  {
    id: "exercises",
    text: "exercises",
    element: exercises.element,
    shown: (shown) => exercises.shown(shown),
  },
]);
new Outside(core, bridge);
const live = new LiveView(core, project, editors, ladder, header);

header.onStatus((status) => watch.showStatus(status));
let lastFault: string | null = null;
header.onStatus(({ fault }) => {
  if (fault !== null && fault !== lastFault) notice(t("fault", fault), true);
  lastFault = fault;
});
header.onRun(() => {
  const { current } = editors;
  const main = project.main();
  if (current === null || main === null || current === main || live.files.includes(current)) return;
  if (isProgram(current)) notice(t("runsMain", main, current));
});
core.on("notice", ({ message, bad }) => notice(message, bad));
tabs.onShown((id) => project.setView(id));
project.onOpened(() => tabs.show(project.view ?? (project.plant === null ? "problems" : "plant")));

const panels = h("aside", { class: "panels", label: "panels" }, tabs.element);
const side = separator({
  label: "sizeOfFiles",
  property: "side-width",
  isColumn: true,
  isAfter: false,
  min: 140,
});
const wide = separator({
  label: "sizeOfPanels",
  property: "panel-width",
  isColumn: true,
  isAfter: true,
  min: 300,
});
document.body.append(
  header.element,
  h("main", {}, sidebar.element, side, place, wide, panels),
  operands.element,
  noticeArea(),
);
/** Where there is no room the files are away until they are asked for. */
const narrow = matchMedia("(max-width: 820px)");
const showFiles = (isShown: boolean) => {
  sidebar.element.classList.toggle("away", narrow.matches && !isShown);
  if (narrow.matches && isShown) scrollTo({ top: 0 });
};
narrow.addEventListener("change", () => showFiles(false));
editors.onCurrent(() => showFiles(false));
showFiles(false);

function chooseValue(): void {
  const { view } = editors;
  const at = view.contentDOM.querySelector(".cm-activeLine .live");
  if (at) valuesMenu(core, editors.live.atCursor(view), at);
  else notice(t("noValueHere"));
}

async function take(opened: Opened): Promise<void> {
  if (watch.forced.length > 0) {
    if (!(await confirm("forced", "leaveForced", "goOn", watch.forced.length))) return;
  }
  const id = await keeper.begin(opened.id, opened.title);
  if (id !== opened.id) notice(t("openElsewhere"), true);
  current = { id, title: opened.title };
  // A reload opens what is open now.
  history.replaceState(null, "", location.pathname + location.search + fragmentFor(id));
  document.title = `${opened.title} – uno200`;
  disk?.opened("");
  project.open(opened.content);
  disk?.opened(id);
}

/** The folder of `uno200 ide`, where the page was opened for it or had it before. */
async function fromBridge(): Promise<Opened | null> {
  if (!bridge || !disk) return null;
  const { isNew } = bridge;
  const wasOpen = lastId()?.startsWith("folder:") ?? false;
  try {
    // A token is good for once: it is exchanged before somebody reloads the page.
    await bridge.connect();
    return bridge.hasFolder && (isNew || wasOpen) ? await disk.open() : null;
  } catch (error) {
    if (isNew || wasOpen) notice(words(error), true);
    return null;
  }
}

async function wanted(): Promise<Opened> {
  let opened: Opened | null = null;
  const folder = await fromBridge();
  try {
    opened = await fromAddress(location.hash);
  } catch (error) {
    notice(error instanceof Unfit ? unfitWords(error) : String(error), true);
  }
  return opened ?? folder ?? lastOrBlink();
}

addEventListener("beforeunload", (event) => {
  if (watch.forced.length > 0 || header.status?.loading) event.preventDefault();
});
addEventListener("hashchange", () => void opening.open(wanted()));
shortcuts({ header, tabs, menu, editors, search: () => (showFiles(true), sidebar.focusSearch()) });
EditorView.findFromDOM(place)?.requestMeasure();
void opening.open(wanted());
void keepOffline();

// Settings and help: two dialogs.
import { LANGUAGES, language, setLanguage, t, type Key } from "../text/language";
import { dialog } from "./dialog";
import { h, select } from "./dom";
import { setTheme, theme, THEMES } from "./theme";
import { labelled } from "../panels/scope";

/** What languages call themselves. */
const NAMES = { en: "English", de: "Deutsch", es: "Español" };

/** Language and colours. */
export function settings(): void {
  const languages = LANGUAGES.map((language) => [language, { plain: NAMES[language] }] as const);
  const themes = THEMES.map((theme) => [theme, `theme-${theme}`] as const);
  const fields = h(
    "div",
    { class: "fields-column" },
    labelled("language", select("language", languages, language(), setLanguage)),
    labelled("appearance", select("appearance", themes, theme(), setTheme)),
  );
  void dialog({ title: t("settings"), body: [fields] });
}

const SHORTCUTS: [string, Key][] = [
  ["F9", "run"],
  ["Shift+F9", "stop"],
  ["Ctrl+F9", "pause"],
  ["F10", "singleScan"],
  ["Ctrl+Space", "helpComplete"],
  ["F8, Shift+F8", "helpProblems"],
  ["F12, Ctrl+Click", "helpDefinition"],
  ["Shift+F12", "helpReferences"],
  ["F2", "helpRename"],
  ["Shift+Alt+F", "helpFormat"],
  ["Alt+Enter", "helpValue"],
  ["Ctrl+F", "helpFind"],
  ["Ctrl+Shift+F", "searchFiles"],
  ["Ctrl+Z, Ctrl+Y", "helpUndo"],
  ["Ctrl+S", "helpSave"],
  ["Esc Tab", "helpLeave"],
  ["F6, Shift+F6", "helpRegions"],
  ["Alt+1 … Alt+9, Alt+0", "helpPanels"],
  ["F1", "help"],
];

/** First steps, and the keys. */
export function help(): void {
  const steps = (["helpStep1", "helpStep2", "helpStep3", "helpStep4"] as const).map((text) =>
    h("li", { text }),
  );
  const rows = SHORTCUTS.map(([keys, text]) =>
    h("tr", {}, h("th", { attributes: { scope: "row" } }, h("kbd", {}, keys)), h("td", { text })),
  );
  void dialog({
    title: t("help"),
    body: [
      h("ol", {}, ...steps),
      h("h3", { text: "shortcuts" }),
      h("table", { class: "keys" }, ...rows),
    ],
  });
}

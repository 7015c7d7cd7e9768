// What is said and asked about the folder that is the project.
import { BridgeRefusal } from "../ports/bridge";
import type { Choice, Talk } from "../project/disk";
import { t } from "../text/language";
import { pick } from "./dialog";
import { notice } from "./notices";

/** So many files are named; of the others it is told how many they are. */
const NAMED_MAX = 3;

export const diskTalk: Talk = {
  choose(file, isGone) {
    const take = t(isGone ? "conflictDelete" : "conflictTake");
    return pick<NonNullable<Choice>>(t(isGone ? "conflictGone" : "conflict", file), [
      { text: t("conflictKeep"), value: "keep" },
      { text: take, value: "take" },
    ]);
  },
  changed: (file) => notice(t("changedOnDisk", file)),
  gone: (file) => notice(t("goneOnDisk", file)),
  unsaved: (file) => notice(t("notSaved", file), true),
  leftOut(files) {
    const named = files.slice(0, NAMED_MAX).map(({ name, why }) => `${name}: ${why}`);
    const more = files.length - named.length;
    if (more > 0) named.push(t("moreProblems", more));
    notice(t("filesLeftOut", named.join("; ")), true);
  },
  note: (text) => notice(text, true),
  failed(error) {
    const isGone = error instanceof BridgeRefusal && error.message === "";
    notice(isGone ? t("folderOutOfReach") : String((error as Error).message ?? error), true);
  },
};

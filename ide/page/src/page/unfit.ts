// What is said of files and projects that cannot be taken.
import { ENDINGS, type Unfit } from "../project/project";
import { t } from "../text/language";

/** The message, with what helps. */
export function unfitWords({ reason, what }: Unfit): string {
  switch (reason) {
    case "name":
      return t("unfitName", what, ENDINGS.join(" "));
    case "exists":
      return t("unfitExists", what);
    case "tooMany":
      return t("unfitTooMany", what);
    case "tooLarge":
      return t("unfitTooLarge", what);
    case "empty":
      return t("unfitEmpty", what);
    case "broken":
      return t("unfitBroken", what);
  }
}

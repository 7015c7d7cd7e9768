// style-mod with sheets of the document instead of <style> elements: a strict
// Content-Security-Policy allows these. esbuild puts it in the place of the package.
import { StyleModule as Original } from "../../node_modules/style-mod/src/style-mod.js";

const sheets = new Map<Original, CSSStyleSheet>();

/** As in the package; `mount` alone is another. */
export class StyleModule extends Original {
  static override mount(_root: Document | ShadowRoot, given: Original | Original[]): void {
    const modules = Array.isArray(given) ? given : [given];
    // The last one of the list wins in the cascade, as the last sheet does.
    for (const module of modules) {
      if (sheets.has(module)) continue;
      const sheet = new CSSStyleSheet();
      sheet.replaceSync(module.getRules());
      sheets.set(module, sheet);
      document.adoptedStyleSheets = [...document.adoptedStyleSheets, sheet];
    }
  }
}

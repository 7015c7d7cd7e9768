// Shows the Markdown of the core's pages: headings, lists, tables, code. No links and no HTML, so
// nothing in it can do anything.
import { h } from "../page/dom";

/** The elements of a text. */
export function markdown(text: string): HTMLElement {
  const result = h("div", { class: "markdown" });
  const lines = text.split("\n");
  let at = 0;
  while (at < lines.length) at = block(lines, at, result);
  return result;
}

/** Adds the block that begins at a line; gives the line after it. */
function block(lines: string[], at: number, into: HTMLElement): number {
  const line = lines[at] ?? "";
  if (line.trim() === "") return at + 1;
  const heading = /^(#{1,6})\s+(.*)/.exec(line);
  if (heading) {
    into.append(inline(h("p", { class: "heading" }), heading[2] ?? ""));
    return at + 1;
  }
  if (line.startsWith("```")) return code(lines, at, into);
  if (line.startsWith("|")) return table(lines, at, into);
  if (/^\s*[*-]\s/.test(line)) return list(lines, at, into);
  return paragraph(lines, at, into);
}

function end(lines: string[], at: number, isIn: (line: string) => boolean): number {
  let end = at;
  while (end < lines.length && isIn(lines[end] ?? "")) end += 1;
  return end;
}

function code(lines: string[], at: number, into: HTMLElement): number {
  const last = end(lines, at + 1, (line) => !line.startsWith("```"));
  into.append(h("pre", {}, h("code", {}, lines.slice(at + 1, last).join("\n"))));
  return last + 1;
}

function table(lines: string[], at: number, into: HTMLElement): number {
  const last = end(lines, at, (line) => line.startsWith("|"));
  const cells = (line: string) => line.replace(/^\||\|\s*$/g, "").split(/(?<!\\)\|/);
  const rows = lines.slice(at, last).filter((line) => !/^\|[\s:|-]+$/.test(line));
  const body = rows.map((line, row) =>
    h("tr", {}, ...cells(line).map((cell) => inline(h(row === 0 ? "th" : "td"), cell.trim()))),
  );
  into.append(h("table", {}, ...body));
  return last;
}

function list(lines: string[], at: number, into: HTMLElement): number {
  const last = end(lines, at, (line) => /^\s*[*-]\s|^\s+\S/.test(line));
  const items: string[] = [];
  for (const line of lines.slice(at, last)) {
    if (/^\s*[*-]\s/.test(line)) items.push(line.replace(/^\s*[*-]\s/, ""));
    else items.push(`${items.pop() ?? ""} ${line.trim()}`);
  }
  into.append(h("ul", {}, ...items.map((item) => inline(h("li"), item))));
  return last;
}

function paragraph(lines: string[], at: number, into: HTMLElement): number {
  const starts = (line: string) => line.trim() === "" || /^(#|```|\||\s*[*-]\s)/.test(line);
  const last = Math.max(
    end(lines, at, (line) => !starts(line)),
    at + 1,
  );
  into.append(inline(h("p"), lines.slice(at, last).join("\n")));
  return last;
}

/** `code`, **strong**, *emphasis* and the words of links. */
function inline<E extends HTMLElement>(into: E, text: string): E {
  const parts = text.split(/(`[^`]+`|\*\*[^*]+\*\*|\*[^*\s][^*]*\*|\[[^\]]+\]\([^)]*\))/);
  for (const part of parts) {
    if (/^`.+`$/.test(part)) into.append(h("code", {}, part.slice(1, -1)));
    else if (/^\*\*.+\*\*$/.test(part)) into.append(h("strong", {}, part.slice(2, -2)));
    else if (/^\*.+\*$/.test(part)) into.append(h("em", {}, part.slice(1, -1)));
    else into.append(part.replace(/^\[([^\]]+)\]\([^)]*\)$/, "$1"));
  }
  return into;
}

// Projects as .zip files and as links.
import { deflateSync, inflateSync, strFromU8, strToU8, unzipSync, zipSync } from "fflate";
import type { File } from "../core/protocol";
import { BYTES_MAX, FILES_MAX, isName, Unfit, type Content } from "./project";
import { contentOf } from "./storage";

/** Longer links are cut off by programs that pass them on. */
export const LINK_MAX = 30_000;
/** The time in a .zip; the same project gives the same bytes. */
const ZIP_TIME = new Date(2000, 0, 1);

/** A .zip with the files. */
export function zipped(files: File[]): Uint8Array<ArrayBuffer> {
  const entries = files.map((file) => [file.name, strToU8(file.text)] as const);
  return zipSync(Object.fromEntries(entries), { mtime: ZIP_TIME });
}

/** The files of a .zip that belong to a project; others in it are left out. */
export function unzipped(bytes: Uint8Array): File[] {
  let size = 0;
  let count = 0;
  const filter = (entry: { name: string; originalSize: number }) => {
    if (!isName(entry.name)) return false;
    size += entry.originalSize;
    count += 1;
    if (size > BYTES_MAX) throw new Unfit("tooLarge", `${BYTES_MAX / 1e6} MB`);
    if (count > FILES_MAX) throw new Unfit("tooMany", String(FILES_MAX));
    return true;
  };
  try {
    const entries = Object.entries(unzipSync(bytes, { filter }));
    return entries.map(([name, bytes]) => ({ name, text: textOf(bytes) }));
  } catch (error) {
    throw error instanceof Unfit ? error : new Unfit("broken");
  }
}

/** The text of a file in one of the encodings that Micro/WIN and editors write. */
export function textOf(bytes: Uint8Array): string {
  if (bytes[0] === 0xff && bytes[1] === 0xfe) return new TextDecoder("utf-16le").decode(bytes);
  if (bytes[0] === 0xfe && bytes[1] === 0xff) return new TextDecoder("utf-16be").decode(bytes);
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder("windows-1252").decode(bytes);
  }
}

/** What a link holds: the project, compressed. */
export function linkPart(content: Content): string {
  const bytes = deflateSync(strToU8(JSON.stringify(content)), { level: 9 });
  const letters = Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
  return btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

/** The project that a link holds. */
export function fromLink(part: string): Content {
  try {
    const letters = atob(part.replaceAll("-", "+").replaceAll("_", "/"));
    const packed = Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
    // A text that is longer does not fit and fails: a small link cannot become a huge project.
    const bytes = inflateSync(packed, { out: new Uint8Array(BYTES_MAX) });
    const content = contentOf(JSON.parse(strFromU8(bytes)));
    if (content) return content;
  } catch {
    // Told below: whatever is wrong with it, it is broken.
  }
  throw new Unfit("broken");
}

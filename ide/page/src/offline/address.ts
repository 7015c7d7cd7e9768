// Where the files of this version of the page are: beside its script.

/** The address of a file that comes with the page. */
export function addressOf(path: string): URL {
  return new URL(path, import.meta.url);
}

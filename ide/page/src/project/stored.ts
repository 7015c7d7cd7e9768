// Small texts that the browser keeps. It may have no room for more, or keep nothing at all: the page
// works nevertheless, and who keeps what people have written says so.

/** What is kept under this name; null where nothing is. */
export function storedText(key: string): string | null {
  try {
    return localStorage.getItem(key);
  } catch {
    return null;
  }
}

/** Keeps a text, or with null nothing, under a name; whether that was done. */
export function store(key: string, text: string | null): boolean {
  try {
    if (text === null) localStorage.removeItem(key);
    else localStorage.setItem(key, text);
    return true;
  } catch {
    return false;
  }
}

/** Names under which something is kept that begin like this. */
export function storedNames(prefix: string): string[] {
  try {
    return Object.keys(localStorage).filter((key) => key.startsWith(prefix));
  } catch {
    return [];
  }
}

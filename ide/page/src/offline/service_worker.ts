// Keeps the page in the browser, so that it opens without its server. Everything that belongs to a
// version is in a folder with that version's name; the page's own file, which is asked for anew
// whenever the server answers, is all that names it. So versions cannot be mixed.

/** The files of this version. The folder has its real name where the page is served. */
const LIST = "version/files.json";
const SCRIPT = "version/page.js";
const PREFIX = "uno200 ";
const NAME = PREFIX + LIST;
/** The page's own file. */
const PAGE = "./";
/** Longer a server that does not answer is not waited for. */
const PATIENCE_MS = 3000;

/** What is used of a service worker's surroundings; the page's types have another `self`. */
interface Lived extends globalThis.Event {
  waitUntil(done: Promise<unknown>): void;
}
interface Fetched extends Lived {
  request: Request;
  respondWith(response: Promise<Response>): void;
}
interface Surroundings {
  addEventListener(kind: "install" | "activate", listener: (event: Lived) => void): void;
  addEventListener(kind: "fetch", listener: (event: Fetched) => void): void;
  skipWaiting(): Promise<void>;
  clients: { claim(): Promise<void> };
}
const surroundings = self as unknown as Surroundings;

/** Takes all files of this version, or none. */
async function keep(): Promise<void> {
  const list = (await (await fetched(LIST)).json()) as string[];
  const page = await fetched(PAGE, "reload");
  // The server may have got another version meanwhile: the browser tries again the next time.
  if (!(await page.clone().text()).includes(SCRIPT)) throw new Error("another version");
  const cache = await caches.open(NAME);
  await Promise.all(list.map(async (path) => cache.put(path, await fetched(path))));
  await cache.put(PAGE, page);
  await surroundings.skipWaiting();
}

async function fetched(path: string, cache: RequestCache = "default"): Promise<Response> {
  const response = await fetch(path, { cache });
  if (!response.ok) throw new Error(`${path}: ${response.status}`);
  return response;
}

/** Forgets old versions. The one before stays: a tab may still show it. */
async function tidy(): Promise<void> {
  const others = (await caches.keys()).filter((name) => name.startsWith(PREFIX) && name !== NAME);
  await Promise.all(others.slice(0, -1).map((name) => caches.delete(name)));
  await surroundings.clients.claim();
}

/** The page of the server, and without one that of this version. */
async function page(request: Request): Promise<Response> {
  try {
    const signal = AbortSignal.timeout(PATIENCE_MS);
    const response = await fetch(request.url, { signal, cache: "no-cache" });
    if (response.status < 500) return response;
    return (await kept(PAGE)) ?? response;
  } catch (error) {
    const response = await kept(PAGE);
    if (response) return response;
    throw error;
  }
}

async function kept(path: string): Promise<Response | undefined> {
  return (await caches.open(NAME)).match(path);
}

/** A file of any version that is kept: its address says which. */
async function file(request: Request): Promise<Response> {
  return (await caches.match(request)) ?? fetch(request);
}

surroundings.addEventListener("install", (event) => event.waitUntil(keep()));
surroundings.addEventListener("activate", (event) => event.waitUntil(tidy()));
surroundings.addEventListener("fetch", (event) => {
  const { request } = event;
  if (request.method !== "GET") return;
  event.respondWith(request.mode === "navigate" ? page(request) : file(request));
});

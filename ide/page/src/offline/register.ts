// Has the browser keep the page: from the next time on it opens without its server, too.

/** Asks for it. A browser that does not do that, or not at such an address, has the page as long as
 * its server answers. */
export async function keepOffline(): Promise<void> {
  if (!("serviceWorker" in navigator)) return;
  try {
    await navigator.serviceWorker.register("sw.js", { updateViaCache: "none" });
  } catch (error) {
    console.info("the page is not kept:", error);
  }
}

// The browser of a test: Debian's Chromium, without what it does beside.
import { chromium } from "playwright-core";

const PATIENCE = 60_000;

/** A browser with a page, and what goes wrong in it. */
export async function open({ width = 1280, height = 800, patience = PATIENCE } = {}) {
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: [
      "--no-sandbox",
      "--disable-gpu",
      "--disable-background-networking",
      "--disable-sync",
      "--no-first-run",
    ],
  });
  const errors = [];
  const page = watched(await browser.newPage({ viewport: { width, height } }), errors, patience);
  return { browser, page, errors };
}

/** A page whose errors are written down. */
export function watched(page, errors, patience = PATIENCE) {
  page.setDefaultTimeout(patience);
  page.on("pageerror", (error) => errors.push(error.message));
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  return page;
}

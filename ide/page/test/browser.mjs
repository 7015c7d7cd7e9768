// The browser of a test: Debian's Chromium, without what it does beside.
import { chromium } from "playwright-core";

const PATIENCE = 60_000;

/** A browser with a page, and what goes wrong in it. */
export async function open(options = {}) {
  const { width = 1280, height = 800, patience = PATIENCE, bypassCSP = false } = options;
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
  const opened = await browser.newPage({ viewport: { width, height }, bypassCSP });
  const page = watched(opened, errors, patience);
  process.once("uncaughtException", (error) => void fail(error, browser, errors));
  return { browser, page, errors };
}

/** What people look for first in a page. */
export function controls(page) {
  return {
    button: (name) => page.getByRole("button", { name, exact: true }),
    tab: (name) => page.getByRole("tab", { name, exact: true }).click(),
    panel: (name) => page.getByRole("tabpanel", { name, exact: true }),
    mode: (wanted) => page.getByRole("status").first().filter({ hasText: wanted }).waitFor(),
  };
}

/** Ends a test that fails, with what could be read in its pages at that time. */
async function fail(error, browser, errors) {
  console.error(error, ...errors);
  for (const page of browser.contexts().flatMap((context) => context.pages()))
    console.error(page.url(), await page.innerText("body", { timeout: 5000 }).catch(String));
  process.exit(1);
}

/** A page whose errors are written down. */
export function watched(page, errors, patience = PATIENCE) {
  page.setDefaultTimeout(patience);
  page.on("pageerror", (error) => errors.push(error.message));
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  return page;
}

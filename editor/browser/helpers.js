// A browser on the built site. `FAIRCURVE_SITE` names the site's folder, `CHROMIUM` another browser,
// `FAIRCURVE_SHOTS` a folder for screenshots.

import { createServer } from "node:http";
import { mkdir, readFile } from "node:fs/promises";
import { extname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

const TYPES = /** @type {Record<string, string>} */ ({ ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml", ".wasm": "application/wasm" });
const SITE = process.env.FAIRCURVE_SITE ?? fileURLToPath(new URL("../../target/editor", import.meta.url));

/** @typedef {import("playwright-core").Page} Page */
/** @typedef {import("playwright-core").Browser} Browser */
/** @typedef {import("../src/app.js").App} App */

/** A file of the repository. @param {string} path */
export const repository = (path) => fileURLToPath(new URL(`../../${path}`, import.meta.url));

/** Serves the site in a folder of any name, as a static host would. */
export async function serve() {
  const server = createServer(async (request, response) => {
    const { pathname } = new URL(request.url ?? "/", "http://localhost");
    const path = decodeURIComponent(pathname).replace(/^\/any folder\//, "/");
    try {
      const bytes = await readFile(join(SITE, path.endsWith("/") ? `${path}index.html` : path));
      response.writeHead(200, { "content-type": TYPES[extname(path)] ?? "text/html" }).end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve(undefined)));
  const { port } = /** @type {import("node:net").AddressInfo} */ (server.address());
  return { url: `http://127.0.0.1:${port}/any%20folder/`, close: () => server.close() };
}

export const launch = () => chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });

/**
 * A page of a fresh profile. What goes wrong in it fails the test.
 * @param {Browser} browser
 * @param {string} url
 * @param {import("playwright-core").BrowserContextOptions} [options]
 */
export async function open(browser, url, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, permissions: ["clipboard-read", "clipboard-write"], ...options });
  const page = await context.newPage();
  /** @type {string[]} */
  const problems = [];
  page.on("pageerror", (error) => problems.push(String(error.stack ?? error)));
  page.on("console", (message) => message.type() === "error" && problems.push(message.text()));
  await page.goto(url);
  await ready(page);
  return { context, page, problems };
}

/** @param {Page} page */
export const ready = (page) => page.waitForSelector("html[data-ready]", { state: "attached" });

/** Where a point of the drawing is in the window. @param {Page} page @param {number} x @param {number} y @returns {Promise<[number, number]>} */
export function at(page, x, y) {
  return page.evaluate(([x, y]) => {
    const { stage } = /** @type {{faircurveEditor: App}} */ (/** @type {unknown} */ (globalThis)).faircurveEditor;
    const { left, top } = stage.canvas.getBoundingClientRect();
    const p = stage.viewport.toScreen({ x, y });
    return [left + p.x, top + p.y];
  }, [x, y]);
}

/** The kept document and selection. @param {Page} page */
export function state(page) {
  return page.evaluate(() => {
    const { editor } = /** @type {{faircurveEditor: App}} */ (/** @type {unknown} */ (globalThis)).faircurveEditor;
    const { document, glyph, selection } = editor.committed;
    return { document, glyph, contours: document.glyphs[glyph].contours, selected: selection.places };
  });
}

/** What the curves are. @param {Page} page */
export function curves(page) {
  return page.evaluate(() => {
    const { stage } = /** @type {{faircurveEditor: App}} */ (/** @type {unknown} */ (globalThis)).faircurveEditor;
    return stage.curves.map((curve) => ({ length: curve.length, spline: curve.spline, relaxed: curve.relaxed, cubics: curve.beziers(0.1).cubics, joins: curve.knots.map((k) => k.join) }));
  });
}

/** @param {Page} page @param {number} x @param {number} y @param {("Shift" | "Control" | "Alt")[]} [modifiers] */
export async function click(page, x, y, modifiers = []) {
  await page.mouse.move(...(await at(page, x, y)));
  for (const key of modifiers) await page.keyboard.down(key);
  await page.mouse.down();
  await page.mouse.up();
  for (const key of modifiers) await page.keyboard.up(key);
}

/** @param {Page} page @param {[number, number]} from @param {[number, number]} to */
export async function drag(page, from, to) {
  await page.mouse.move(...(await at(page, ...from)));
  await page.mouse.down();
  await page.mouse.move(...(await at(page, ...to)), { steps: 8 });
  await page.mouse.up();
}

/** What a press of keys or a click downloads. @param {Page} page @param {() => Promise<unknown>} act */
export async function downloaded(page, act) {
  const [download] = await Promise.all([page.waitForEvent("download"), act()]);
  const path = await download.path();
  return { name: download.suggestedFilename(), text: await readFile(path, "utf8") };
}

/** @param {Page} page @param {() => Promise<unknown>} act @param {string | {name: string, mimeType: string, buffer: Buffer}} file */
export async function choose(page, act, file) {
  const [chooser] = await Promise.all([page.waitForEvent("filechooser"), act()]);
  await chooser.setFiles(file);
}

/** A screenshot, where they are wanted. @param {Page} page @param {string} name */
export async function shot(page, name) {
  const folder = process.env.FAIRCURVE_SHOTS;
  if (!folder) return;
  await mkdir(folder, { recursive: true });
  await page.waitForTimeout(150);
  await page.screenshot({ path: join(folder, `${name}.png`) });
}

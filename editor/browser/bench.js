// How long frames of a drag take, and how long the page takes to its first curve: `node browser/bench.js`.
// Times are those of this machine at this moment; nothing fails by them.

import { existsSync } from "node:fs";
import { EXAMPLES } from "../src/examples.js";
import { toFragment } from "../src/core/link.js";
import { at, choose, launch, open, repository, serve } from "./helpers.js";

const FRAMES = 400;

/** @param {number[]} times @param {number} part */
const quantile = (times, part) => times.toSorted((a, b) => a - b)[Math.min(times.length - 1, Math.floor(part * times.length))];
/** @param {string} name @param {number[]} times */
const tell = (name, times) => console.log(`${name.padEnd(58)} median ${quantile(times, 0.5).toFixed(1)} ms, 99th percentile ${quantile(times, 0.99).toFixed(1)} ms`);

const site = await serve();
const browser = await launch();

/**
 * What Chromium spends between two marks of the page, from its trace: the tasks of the page's main thread, and those of all its
 * threads and of the graphics process together, as if nothing ran beside anything else.
 * @param {any[]} events
 * @returns {{main: number[], all: number[]}} milliseconds, one a frame
 */
function wholeFrames(events) {
  const marks = events.filter(({ name, cat }) => name === "frame" && cat.includes("user_timing"));
  const [{ pid, tid }] = marks;
  const ends = marks.map(({ ts }) => ts).sort((a, b) => a - b);
  const main = ends.slice(1).map(() => 0);
  const all = [...main];
  const graphics = new Set(events.filter((e) => e.name === "thread_name" && e.args.name === "CrGpuMain").map((e) => e.pid));
  const tasks = events.filter(({ name, ph }) => ph === "X" && /RunTask$/.test(name));
  for (const { pid: process, tid: thread, ts, dur = 0 } of tasks) {
    // The program that drives the browser is served by the browser's own process.
    const isGraphics = graphics.has(process);
    if (process !== pid && !isGraphics) continue;
    const frame = ends.findLastIndex((end) => end <= ts);
    if (frame < 0 || frame >= main.length) continue;
    all[frame] += dur / 1000;
    if (process === pid && thread === tid) main[frame] += dur / 1000;
  }
  return { main, all };
}

/** A round blob of so many knots. @param {number} count */
const blob = (count) => ({
  faircurve: 1,
  contours: [{
    closed: true,
    knots: Array.from({ length: count }, (_, i) => {
      const angle = (2 * Math.PI * i) / count;
      const radius = 400 + 60 * Math.sin(9 * angle) + 12 * Math.cos(31 * angle);
      return { x: Math.round(radius * Math.cos(angle)), y: Math.round(radius * Math.sin(angle)) };
    }),
  }],
});

/**
 * Drags a knot around, and measures each frame: the script from the pointer's event to the last line drawn; and, by a trace,
 * the whole frame with style, layout, painting and what other threads do with it.
 * @param {string} name
 * @param {(page: import("./helpers.js").Page) => Promise<void>} prepare
 * @param {string[]} keys
 */
async function dragged(name, prepare, keys = []) {
  const { page, context } = await open(browser, site.url);
  await prepare(page);
  for (const key of keys) await page.keyboard.press(key);
  const [contour, knot] = await page.evaluate(() => {
    const { contours } = /** @type {any} */ (globalThis).faircurveEditor.editor;
    const longest = contours.reduce((/** @type {number} */ best, /** @type {any} */ c, /** @type {number} */ i) => (c.knots.length > contours[best].knots.length ? i : best), 0);
    return [longest, Math.floor(contours[longest].knots.length / 2)];
  });
  const { x, y } = await page.evaluate(([c, k]) => /** @type {any} */ (globalThis).faircurveEditor.editor.contours[c].knots[k], [contour, knot]);
  const from = await at(page, x, y);
  await page.mouse.move(...from);
  await page.mouse.down();
  const script = await page.evaluate(async ([x, y, frames]) => {
    const { stage } = /** @type {any} */ (globalThis).faircurveEditor;
    const times = [];
    for (let i = 0; i < frames; i++) {
      const angle = i / 20;
      const begin = performance.now();
      stage.canvas.dispatchEvent(new PointerEvent("pointermove", { clientX: x + 30 * Math.sin(angle), clientY: y + 20 * Math.sin(1.7 * angle), pointerId: 1, pointerType: "mouse", bubbles: true }));
      stage.draw();
      times.push(performance.now() - begin);
      // The screen gets its turn.
      await new Promise((resolve) => requestAnimationFrame(resolve));
    }
    return times.slice(20);
  }, /** @type {[number, number, number]} */ ([...from, FRAMES]));
  await browser.startTracing(page, { categories: ["toplevel", "blink.user_timing", "__metadata"] });
  await page.evaluate(async ([x, y, frames]) => {
    const { stage } = /** @type {any} */ (globalThis).faircurveEditor;
    for (let i = 0; i < frames; i++) {
      performance.mark("frame");
      const angle = i / 20;
      stage.canvas.dispatchEvent(new PointerEvent("pointermove", { clientX: x + 30 * Math.sin(angle), clientY: y + 20 * Math.sin(1.7 * angle), pointerId: 1, pointerType: "mouse", bubbles: true }));
      // The page draws in the next frame, and it is on the screen after the one that follows.
      await new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
    }
  }, /** @type {[number, number, number]} */ ([...from, FRAMES]));
  const { traceEvents } = JSON.parse(String(await browser.stopTracing()));
  const { main, all } = wholeFrames(traceEvents);
  console.log(name);
  tell("  script", script);
  tell("  main thread, whole frame", main.slice(20));
  tell("  all threads, whole frame", all.slice(20));
  await page.mouse.up();
  await context.close();
}

const font = repository("../shared/data/Chomsky.sfd");
const ofFile = (/** @type {string} */ name, /** @type {unknown} */ json) => async (/** @type {import("./helpers.js").Page} */ page) => {
  await choose(page, () => page.keyboard.press("Control+o"), { name, mimeType: "application/json", buffer: Buffer.from(JSON.stringify(json)) });
  await page.waitForFunction((name) => document.querySelector("#name")?.textContent === name, name);
};
if (existsSync(font)) {
  const glyph = async (/** @type {import("./helpers.js").Page} */ page) => {
    await choose(page, () => page.keyboard.press("Control+o"), font);
    await page.waitForFunction(() => document.querySelector("#name")?.textContent?.endsWith(".sfd"));
    await page.getByLabel("Glyph").selectOption({ label: "M" });
  };
  await dragged("drag in Chomsky's M, 242 knots", glyph);
  await dragged("the same with comb, extrema, Béziers and plot", glyph, ["c", "e", "b", "u"]);
}
await dragged("drag in one contour of 250 knots", ofFile("blob.json", blob(250)));
await dragged("the same with comb and plot", ofFile("blob.json", blob(250)), ["c", "u"]);
await dragged("drag in one contour of 16 knots", ofFile("blob.json", blob(16)));

// A link with a letter, in profiles that have never seen the page: to the moment when its curve is drawn.
const letter = await toFragment(EXAMPLES[0].document);
const starts = [];
for (let i = 0; i < 7; i++) {
  const context = await browser.newContext();
  const page = await context.newPage();
  await page.addInitScript(() => {
    // Only curves are stroked as paths made before.
    const prototype = /** @type {any} */ (CanvasRenderingContext2D.prototype);
    const { stroke } = prototype;
    prototype.stroke = function (/** @type {unknown[]} */ ...path) {
      if (path.length > 0) /** @type {any} */ (globalThis).firstCurve ??= performance.now();
      return stroke.apply(this, path);
    };
  });
  await page.goto(site.url + letter);
  await page.waitForFunction(() => /** @type {any} */ (globalThis).firstCurve);
  starts.push(await page.evaluate(() => /** @type {any} */ (globalThis).firstCurve));
  await context.close();
}
tell("cold start to the first curve", starts);
await browser.close();
site.close();

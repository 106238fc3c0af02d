// Sizes, starts, times and a drag. Times are those of this machine and of the moment: run it when nothing else does.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { solve } from "faircurve";
import "faircurve/splines";
import { browserPath, withPage } from "../test/browser.js";
import { drag } from "./drag.js";
import { median, outline, quantile } from "./drawings.js";

const spiro = createRequire(import.meta.url)("spiro");
const installed = "node_modules/faircurve";

function heading(text) {
  console.log(`\n${text}`);
}

function sizes() {
  heading("Size, kB of 1000 bytes: as it is, gzipped");
  const kB = (files) => {
    const bytes = files.map((file) => readFileSync(join(installed, file)));
    const plain = bytes.reduce((sum, b) => sum + b.length, 0);
    const zipped = bytes.reduce((sum, b) => sum + gzipSync(b, { level: 9 }).length, 0);
    return `${(plain / 1000).toFixed(1).padStart(8)} ${(zipped / 1000).toFixed(1).padStart(8)}`;
  };
  console.log(`solver module   ${kB(["wasm/solver_bg.wasm"])}`);
  console.log(`its JavaScript  ${kB(["index.js"])}`);
  console.log(`splines module  ${kB(["wasm/splines_bg.wasm"])}`);
  console.log(`its JavaScript  ${kB(["splines.js"])}`);
  console.log(`formats module  ${kB(["wasm/formats_bg.wasm"])}`);
  console.log(`its JavaScript  ${kB(["formats.js"])}`);
}

/** µs of each call, for 250 ms of every one, in turns, so that what the machine does meanwhile meets them all. */
function rounds(calls) {
  const taken = calls.map(() => []);
  const end = performance.now() + 250 * calls.length;
  for (let round = 0; round < 20 || performance.now() < end; round++) {
    calls.forEach((call, i) => {
      const start = performance.now();
      call();
      taken[i].push(1000 * (performance.now() - start));
    });
  }
  return taken;
}

/** µs of one call of each: the lower quartile, which a busy machine changes least. */
function times(calls) {
  rounds(calls); // while the engine still compiles
  return rounds(calls).map((list) => quantile(list, 0.25));
}

function native(counts) {
  writeFileSync("points.json", JSON.stringify(counts.map((n) => outline(n).map(({ x, y }) => [x, y]))));
  const words = ["run", "--release", "--quiet", "-p", "faircurve", "--example", "solve_times", "--"];
  const options = { cwd: process.env.FAIRCURVE_ROOT, encoding: "utf8", stdio: ["ignore", "pipe", "inherit"] };
  return execFileSync("cargo", [...words, join(process.cwd(), "points.json")], options)
    .trim()
    .split("\n")
    .map((line) => line.split(" ").map(Number));
}

function solving() {
  // Levien's spline-research, JavaScript, µs, as measured beside npm's spiro in November 2026.
  const RESEARCH = [["bespoke", 64, 594], ["bespoke", 1024, 15700], ["euler", 64, 1239], ["euler", 1024, 26861]];
  heading("Times, µs, closed contours of all-g4 knots (Node): solve; solve and Béziers");
  const counts = [16, 64, 256];
  const rust = native(counts);
  console.log("knots  native         wasm           npm spiro      ratios");
  counts.forEach((n, i) => {
    const contours = [{ closed: true, knots: outline(n) }];
    const theirs = outline(n).map((knot) => ({ ...knot, type: "g4" }));
    const drawn = () => {
      const [curve] = solve({ contours }).contours;
      curve.beziers(0.1);
      curve.free();
    };
    const ours = [() => solve({ contours }).contours[0].free(), drawn];
    const others = [() => spiro.spiroToArcs(theirs, true), () => spiro.spiroToBezier(theirs, true)];
    // Each with what it is compared to, and nothing else between them.
    const [solves, draws] = [0, 1].map((i) => times([ours[i], others[i]]));
    const ratios = [solves, draws].map(([own, other]) => (other / own).toFixed(1));
    const pair = ([a, b]) => `${a.toFixed(0).padStart(5)} ${b.toFixed(0).padStart(6)}   `;
    const [own, other] = [0, 1].map((who) => pair([solves[who], draws[who]]));
    console.log(`${String(n).padStart(5)} ${pair(rust[i])} ${own} ${other} ${ratios.join(" ")}`);
  });
  for (const [spline, count, theirs] of RESEARCH) {
    const contours = [{ spline, closed: true, knots: outline(count) }];
    const [ours] = times([() => solve({ contours }).contours[0].free()]);
    const ratio = (theirs / ours).toFixed(1);
    console.log(`${count} knots, ${spline}, solve alone: ${ours.toFixed(0)}; spline-research ${theirs}; ratio ${ratio}`);
  }
}

function processorTime() {
  const { user, system } = process.cpuUsage();
  return (user + system) / 1000;
}

const FIRST = `
  const start = performance.now();
  const { solve } = await import(SOURCE);
  const [curve] = solve({ contours: [{ closed: true, knots: [{ x: 0, y: 0 }, { x: 90, y: 10 }, { x: 50, y: 80 }, { x: 10, y: 70 }] }] }).contours;
  const path = curve.toSVG();
`;

async function starts() {
  heading("From nothing to the first curve, ms: middle of 15");
  const script = `${FIRST.replace("SOURCE", '"faircurve"')} console.log(performance.now() - start);`;
  const inNode = (text) => Array.from({ length: 15 }, () => Number(execFileSync("node", ["--input-type=module", "-e", text])));
  console.log(`Node      ${median(inNode(script)).toFixed(1)}`);
  const cpu = `${processorTime} ${script.replaceAll("performance.now()", "processorTime()")}`;
  console.log(`Node, cpu ${median(inNode(cpu)).toFixed(1)}`);
  if (!browserPath) return;
  await withPage(process.cwd(), async (page, address) => {
    const source = JSON.stringify(`${address}/${installed}/index.js`);
    writeFileSync("empty.js", "export {};");
    writeFileSync("named.html", `<!doctype html>
      <link rel="modulepreload" href="/${installed}/index.js">
      <link rel="preload" href="/${installed}/wasm/solver_bg.wasm" as="fetch" crossorigin>`);
    const nothing = `const start = performance.now(); await import("${address}/empty.js");`;
    const first = FIRST.replace("SOURCE", source);
    // A page that is still loading shares the processor with the browser, which goes on starting for a second
    // after the page has loaded (with two processors).
    const REST = 2500;
    for (const [path, rest, script, when] of [
      ["named.html", REST, first, "page at rest that names both files at its top, as the README says"],
      ["empty", REST, first, "page at rest"],
      ["empty", 300, first, "page loaded 0.3 s ago"],
      ["empty", 0, first, "page loading"],
      ["empty", REST, nothing, "page at rest, import of a module without a word in it"],
    ]) {
      const inBrowser = [];
      for (let i = 0; i < 15; i++) {
        const context = await page.context().browser().newContext();
        const fresh = await context.newPage();
        await fresh.goto(`${address}/${path}`);
        await fresh.waitForTimeout(rest);
        inBrowser.push(await fresh.evaluate(`(async () => { ${script} return performance.now() - start; })()`));
        await context.close();
      }
      console.log(`Chromium  ${median(inBrowser).toFixed(1)}, ${when}`);
    }
  });
}

async function drags() {
  heading("A knot of 250 dragged 1000 times, solve and Béziers, ms: middle, 99th percentile, longest; from anew");
  const cases = [{ spline: "spiro" }, { spline: "spiro", far: 0.8 }, { spline: "spiro", join: "g2" }, { spline: "euler" }];
  const name = ({ spline, join, far }) => `${spline} ${join ?? ""}${far ? "far" : ""}`.padEnd(10);
  for (const each of cases) console.log(`Node      ${name(each)} ${drag(each).join(" ")}`);
  // What this process had of the processors, collecting garbage and compiling included: on a busy machine the better number.
  for (const each of cases) console.log(`Node, cpu ${name(each)} ${drag({ ...each, clock: processorTime }).join(" ")}`);
  if (!browserPath) return;
  await withPage(process.cwd(), async (page, address) => {
    await page.goto(`${address}/empty`);
    await page.setContent(`<script type="importmap">{ "imports": { "faircurve": "/${installed}/index.js" } }</script>`);
    for (const each of cases) {
      const numbers = await page.evaluate(async ([at, options]) => {
        const { drag } = await import(`${at}/bench/drag.js`);
        return drag(options);
      }, [address, each]);
      console.log(`Chromium  ${name(each)} ${numbers.join(" ")}`);
    }
  });
}

sizes();
solving();
await starts();
await drags();

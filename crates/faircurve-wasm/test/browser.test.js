// The package in a real browser, without a bundler: the solver, paths, and the examples.
import assert from "node:assert/strict";
import { test } from "node:test";
import { browserPath, withPage } from "./browser.js";

const skip = browserPath ? false : "there is no chromium: apt-get install chromium, or set CHROMIUM";
const here = process.cwd();

test("solving, Path2D, and the formats only when they are asked for", { skip }, () =>
  withPage(here, async (page, address, errors) => {
    await page.goto(`${address}/empty`);
    const loaded = [];
    page.on("request", (request) => loaded.push(request.url()));
    const result = await page.evaluate(async (at) => {
      const { solve, LiveContour, FaircurveError } = await import(`${at}/node_modules/faircurve/index.js`);
      const knots = [{ x: 20, y: 50 }, { x: 80, y: 20 }, { x: 130, y: 70 }, { x: 60, y: 110 }];
      const curve = solve({ contours: [{ closed: true, knots }] }).contours[0];
      const context = document.createElement("canvas").getContext("2d");
      const live = new LiveContour({ closed: true, knots });
      live.move(0, 10, 50);
      let error;
      try {
        solve({ spline: "spirro", contours: [{ knots }] });
      } catch (e) {
        error = e instanceof FaircurveError && e.hint;
      }
      return {
        inside: context.isPointInPath(curve.toPath2D(), 75, 60),
        outside: context.isPointInPath(live.beziers().toPath2D(), 300, 60),
        longer: live.curve.length > curve.length,
        error,
      };
    }, address);
    assert.deepEqual(result, { inside: true, outside: false, longer: true, error: "did you mean `spiro`?" });
    assert.ok(loaded.some((url) => url.endsWith("solver_bg.wasm")) && !loaded.some((url) => /formats|splines/.test(url)));
    const csv = await page.evaluate(async (at) => {
      const { read, write } = await import(`${at}/node_modules/faircurve/formats.js`);
      return write(read("0,0\n10,5\n", "csv"), "csv");
    }, address);
    assert.match(csv, /0,0/);
    const vertices = await page.evaluate(async (at) => {
      const { solve } = await import(`${at}/node_modules/faircurve/index.js`);
      await import(`${at}/node_modules/faircurve/splines.js`);
      const knots = [{ x: 20, y: 50 }, { x: 80, y: 20 }, { x: 130, y: 70 }];
      return solve({ spline: "kappa", contours: [{ closed: true, knots }] }).contours[0].status;
    }, address);
    assert.equal(vertices, "solved");
    assert.deepEqual(errors, []);
  }));

test("the page: a knot is dragged", { skip }, () =>
  withPage(here, async (page, address, errors) => {
    await page.goto(`${address}/examples/page.html`);
    const length = () => page.textContent("#length");
    await page.waitForFunction(() => document.querySelector("#length").textContent !== "");
    const before = await length();
    const canvas = await page.locator("canvas").boundingBox();
    const [x, y] = [canvas.x + 1 + 120, canvas.y + 1 + 240];
    await page.mouse.move(x, y);
    await page.mouse.down();
    for (let i = 1; i <= 20; i++) await page.mouse.move(x - 3 * i, y + 2 * i);
    await page.mouse.up();
    assert.match(before, /^length \d+\.\d\d$/);
    assert.notEqual(await length(), before);
    assert.deepEqual(errors, []);
  }));

test("the chart: a route with a gap, and an island", { skip }, () =>
  withPage(here, async (page, address, errors) => {
    await page.goto(`${address}/examples/chart.html`);
    await page.waitForFunction(() => document.querySelectorAll("path").length === 2, { timeout: 10_000 }).catch(() => assert.deepEqual(errors, []));
    const [route, island] = await page.$$eval("path", (paths) => paths.map((path) => path.getAttribute("d")));
    assert.equal(route.match(/M/g).length, 2);
    assert.match(island, /^M330,230C.*Z$/);
    assert.doesNotMatch(route + island, /NaN/);
    assert.deepEqual(errors, []);
  }));

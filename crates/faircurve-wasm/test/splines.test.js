// The module of all splines: asked for in words, loaded once; and what the first module weighs.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { gzipSync } from "node:zlib";
import { line } from "d3-shape";
import { catalogue, LiveContour, solve } from "faircurve";
import { curveFair } from "faircurve/d3";

const knots = [{ x: 0, y: 0 }, { x: 90, y: 10 }, { x: 60, y: 80 }, { x: 10, y: 70 }];
const points = knots.map(({ x, y }) => [x, y]);
const by = (spline, closed = true) => solve({ spline, contours: [{ closed, knots }] }).contours[0];

test("the first module is small", () => {
  const module = readFileSync("node_modules/faircurve/wasm/solver_bg.wasm");
  const size = gzipSync(module, { level: 9 }).length;
  assert.ok(size <= 200_000, `${size} bytes gzipped`);
});

test("spiro, euler and hobby are there at once, the catalogue is whole, the rest is loaded", async () => {
  const first = catalogue.filter(({ name }) => ["spiro", "euler", "hobby"].includes(name));
  assert.equal(first.length, 3);
  first.forEach(({ name }) => assert.equal(by(name).status, "solved"));
  assert.deepEqual(first.map(({ continuity }) => continuity), [4, 2, 1]);
  assert.ok(line().curve(curveFair.spline("hobby").tension(1.1))(points).startsWith("M0,0C"));

  const live = new LiveContour({ closed: true, knots });
  const shown = live.beziers().toSVG();
  const rest = catalogue.filter((info) => !first.includes(info));
  for (const { name } of rest) {
    const missing = { name: "FaircurveError", message: `the module that has spline \`${name}\` isn't loaded`, hint: /import "faircurve\/splines"/ };
    assert.throws(() => by(name), missing);
    assert.throws(() => line().curve(curveFair.spline(name))(points), missing);
    assert.throws(() => live.setSpline({ spline: name }), missing);
  }
  assert.equal(live.beziers().toSVG(), shown, "the curve is as it was");

  await import("faircurve/splines");
  rest.forEach(({ name }) => assert.ok(by(name).length > 0));
  assert.ok(line().curve(curveFair.spline("bespoke"))(points).startsWith("M0,0C"));
});

test("a live contour goes from one module to the other and back", async () => {
  await import("faircurve/splines");
  const live = new LiveContour({ spline: "euler", closed: true, knots });
  const start = live.snapshot();
  for (const spline of ["mvc", "kappa", "spiro", "hobby", "bespoke", "euler"]) {
    live.setSpline({ spline });
    const middle = live.snapshot();
    assert.equal(live.curve.spline, spline);
    assert.ok(Math.abs(live.curve.length - by(spline).length) < 1e-9 * live.curve.length);
    live.restore(middle);
    assert.ok(Math.abs(live.curve.length - by(spline).length) < 1e-9 * live.curve.length);
    live.move(1, 95, 15);
    live.settle();
    live.move(1, 90, 10);
  }
  // A curve that can't be: the contour stays what it was, and the next that can be follows.
  live.setSpline({ spline: "mvc" });
  live.move(0, NaN, 0);
  assert.throws(() => live.curve, { message: "x of knot 0 is not a finite number" });
  live.move(0, 0, 0);
  assert.ok(Math.abs(live.curve.length - by("mvc").length) < 1e-9 * live.curve.length);
  live.setClosed(false);
  live.restore(start);
  assert.equal(live.curve.spline, "euler");
  live.free();
});

test("an unknown spline is asked back about among all", () => {
  assert.throws(() => by("kapa"), { message: "there is no spline `kapa`", hint: "did you mean `kappa`?" });
});

// The d3 curve factory beside d3's own.
import assert from "node:assert/strict";
import { test } from "node:test";
import { area, curveLinearClosed, curveLinear, line, lineRadial } from "d3-shape";
import { curveFair, curveFairClosed } from "faircurve/d3";
import "faircurve/splines";

const points = [[0, 0], [50, 40], [90, 10], [150, 60]];
const shape = (path) => path?.replace(/[-\d.e,]+/g, "#") ?? null;

test("0, 1 and 2 points are those of d3's own curves", () => {
  for (const n of [0, 1, 2]) {
    assert.equal(line().curve(curveFair)(points.slice(0, n)), line().curve(curveLinear)(points.slice(0, n)));
    assert.equal(area().curve(curveFair)(points.slice(0, n)), area().curve(curveLinear)(points.slice(0, n)));
    assert.equal(line().curve(curveFairClosed)(points.slice(0, n)), line().curve(curveLinearClosed)(points.slice(0, n)));
  }
});

test("gaps divide the line, and areas have their four sides", () => {
  const gap = [...points, null, [200, 0], null, [210, 5], [230, 60], [260, 0]];
  const path = line().defined((d) => d !== null).curve(curveFair)(gap);
  assert.equal(path.match(/M/g).length, 3);
  assert.match(path, /M200,0Z/);
  const filled = area().curve(curveFair).y0(0)(points);
  assert.match(shape(filled), /^M#C.*L#.*Z$/);
});

test("choices chain, and don't change what they come from", () => {
  const draw = (curve) => line().curve(curve)(points);
  const tight = curveFair.spline("hobby").tension(3);
  assert.notEqual(draw(tight), draw(curveFair.spline("hobby")));
  assert.equal(draw(tight), draw(tight));
  assert.equal(draw(curveFair), draw(curveFair.spline("spiro")));
  assert.notEqual(draw(curveFair.join("corner")), draw(curveFair));
  const aesthetic = curveFair.spline("log-aesthetic");
  assert.notEqual(draw(aesthetic.alpha(0.5)), draw(aesthetic.alpha(2)));
  const cubics = (curve) => draw(curve).match(/C/g).length;
  assert.ok(cubics(curveFair.accuracy(1e-6)) > cubics(curveFair));
  assert.throws(() => draw(curveFair.spline("hobbi")), { name: "FaircurveError" });
  assert.ok(lineRadial().curve(curveFair)([[0, 10], [1, 12], [2, 10]]).includes("C"));
});

test("no NaN in a path", () => {
  const path = line().curve(curveFair)([[0, 0], [NaN, 3], [10, 20], [20, Infinity], [30, 0], [30, 0]]);
  assert.doesNotMatch(path, /NaN|Infinity/);
  assert.match(path, /^M0,0C.*30,0$/);
  assert.equal(line().curve(curveFairClosed)([[NaN, 0]]), line().curve(curveLinear)([]));
});

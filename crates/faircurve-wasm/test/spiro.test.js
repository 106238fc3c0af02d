// The calls of npm's `spiro`, beside it.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { test } from "node:test";
import * as own from "faircurve/spiro";

const theirs = createRequire(import.meta.url)("spiro");

class Log {
  calls = [];
  beginShape = (...n) => this.calls.push(["beginShape", ...n]);
  endShape = (...n) => this.calls.push(["endShape", ...n]);
  moveTo = (...n) => this.calls.push(["moveTo", ...n]);
  lineTo = (...n) => this.calls.push(["lineTo", ...n]);
  cubicTo = (...n) => this.calls.push(["cubicTo", ...n]);
}

function play(spiro, knots, closed) {
  const log = new Log();
  const af = function (...n) {
    this.calls.push(["af", ...n]);
  };
  spiro.spiroToBezierOnContext(knots.map((knot) => ({ ...knot, af })), closed, log);
  return log.calls;
}

/** Which calls come, runs of cubics as one, with the places of knots. */
const outline = (calls) =>
  calls
    .filter(([name], i) => name !== "cubicTo" || calls[i - 1][0] !== "cubicTo")
    .map(([name, ...n]) => (name === "cubicTo" ? name : [name, ...n.map((x) => x.toFixed(6))].join()));

const knot = (x, y, type) => ({ x, y, type });
const drawings = [
  [[knot(0, 0, "open"), knot(100, 50, "g2"), knot(200, 0, "open_end")], false],
  [[knot(0, 0, "g4"), knot(100, 50, "g4"), knot(200, 0, "g2"), knot(120, -90, "g4")], true],
  [[knot(0, 0, "corner"), knot(100, 0, "corner"), knot(100, 100, "corner")], true],
  [[knot(0, 0, "open"), knot(100, 50, "g4"), knot(200, 0, "left"), knot(300, -100, "open_end")], false],
  [[knot(0, 0, "open"), knot(100, 0, "right"), knot(180, 30, "g4"), knot(240, 90, "open_end")], false],
  [[], true],
];

test("the same calls in the same order", () => {
  for (const [knots, closed] of drawings) {
    assert.deepEqual(outline(play(own, knots, closed)), outline(play(theirs, knots, closed)));
  }
});

test("the same curve", () => {
  for (const [knots, closed] of drawings.slice(0, 2)) {
    const arcs = theirs.spiroToArcs(knots, closed);
    const strands = own.spiroToBezier(knots, closed);
    const points = strands.flatMap(({ order, start, c1, c2, end }) => {
      assert.equal(order, 3);
      return Array.from({ length: 50 }, (_, i) => {
        const [t, u] = [i / 50, 1 - i / 50];
        const at = (k) => u ** 3 * start[k] + 3 * u * u * t * c1[k] + 3 * u * t * t * c2[k] + t ** 3 * end[k];
        return [at("x"), at("y")];
      });
    });
    for (const arc of arcs) {
      const { x, y } = arc.eval(0.4);
      assert.ok(Math.min(...points.map(([px, py]) => Math.hypot(px - x, py - y))) < 2, `${x} ${y}`);
    }
  }
});

test("where theirs writes NaN, ours says what is wrong", () => {
  const bad = [knot(0, 0, "g4"), knot(100, NaN, "g4"), knot(200, 0, "g4")];
  assert.ok(play(theirs, bad, true).flat().some(Number.isNaN));
  assert.throws(() => play(own, bad, true), { name: "FaircurveError", message: "y of knot 1 is not a finite number" });
});

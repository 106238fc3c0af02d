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

class ArcLog {
  calls = [];
  beginShape = (...n) => this.calls.push(["beginShape", ...n]);
  endShape = (...n) => this.calls.push(["endShape", ...n]);
  moveTo = (...n) => this.calls.push(["moveTo", ...n]);
  arcTo = (arc, ...n) => this.calls.push(["arcTo", arc.x0, arc.y0, arc.x1, arc.y1, ...n]);
}

const near = (a, b, within, what) => {
  for (const key of Object.keys(b)) assert.ok(Math.abs(a[key] - b[key]) <= within, `${what}.${key}: ${a[key]} ${b[key]}`);
};

test("the same calls with arcs", () => {
  for (const [knots, closed] of drawings) {
    const [ours, other] = [own, theirs].map((spiro) => {
      const log = new ArcLog();
      const af = (...n) => log.calls.push(["af", ...n]);
      spiro.spiroToArcsOnContext(knots.map((knot) => ({ ...knot, af })), closed, log);
      return log.calls;
    });
    assert.deepEqual(ours, other);
  }
});

test("the same arcs", () => {
  const of = ({ x0, y0, x1, y1, arcLength, bend, deriveX0, deriveY0, deriveX1, deriveY1 }) => ({
    ...{ x0, y0, x1, y1, arcLength, bend, deriveX0, deriveY0, deriveX1, deriveY1 },
  });
  for (const [knots, closed] of drawings) {
    const [ours, other] = [own, theirs].map((spiro) => spiro.spiroToArcs(knots, closed));
    assert.equal(ours.length, other.length);
    // Theirs are solved to 1e-4 or so.
    ours.forEach((arc, i) => near(of(arc), of(other[i]), 1e-2, `arc ${i}`));
  }
});

test("arcs answer as theirs do", () => {
  for (const k of [[1.5, 2, -1, 3], [0, 0, 0, 0], [-4, 1, 30, -100], [0.2, 12, 0, 0]]) {
    const [ours, other] = [own, theirs].map(({ SpiroArc }) => new SpiroArc(k, 1, 2, 4, 6));
    for (const at of [0, 0.2, 0.5, 0.77, 1]) {
      near(ours.eval(at), other.eval(at), 1e-4, `eval ${k} ${at}`);
      near(ours.derivative(at), other.derivative(at), 1e-3, `derivative ${k} ${at}`);
    }
    ours.subdivide(0.3).forEach((part, i) => {
      const mine = part.eval(0.5);
      near(mine, ours.eval(i === 0 ? 0.15 : 0.65), 1e-12, `part ${i} of ${k}`);
      near({ bend: part.bend }, { bend: other.subdivide(0.3)[i].bend }, 1e-12, `part ${i} of ${k}`);
    });
    ours.toCubicBezier().forEach((point, i) => near(point, other.toCubicBezier()[i], 1e-3, `cubic ${i} of ${k}`));
  }
});

test("an arc that there is not says so", () => {
  assert.throws(() => new own.SpiroArc([2 * Math.PI * 1e308, 0, 0, NaN], 0, 0, 1, 1), { name: "FaircurveError" });
  assert.throws(() => new own.SpiroArc([0, 0, 0, 0], 0, 0, Infinity, 1), { name: "FaircurveError" });
  assert.equal(new own.SpiroArc([1, 0, 0, 0], 3, 3, 3, 3).arcLength, 0);
});

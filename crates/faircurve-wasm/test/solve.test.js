// The solver in Node.
import assert from "node:assert/strict";
import { test } from "node:test";
import { catalogue, Conversion, FaircurveError, joins, LiveContour, solve } from "faircurve";
import "faircurve/splines";

const circle = (n, r = 100) =>
  Array.from({ length: n }, (_, i) => ({ x: r * Math.cos((2 * Math.PI * i) / n), y: r * Math.sin((2 * Math.PI * i) / n) }));
const one = (contour, document = {}) => solve({ ...document, contours: [contour] }).contours[0];

test("a circle is a circle", () => {
  for (const spline of ["spiro", "euler"]) {
    const curve = one({ closed: true, knots: circle(5) }, { spline });
    assert.equal(curve.status, "solved");
    assert.ok(Math.abs(curve.length - 200 * Math.PI) < 1e-9);
    const { x, y, direction, curvature } = curve.at(50 * Math.PI);
    assert.ok(Math.hypot(x, y - 100) < 1e-9 && Math.abs(Math.abs(direction) - Math.PI) < 1e-9);
    assert.ok(Math.abs(curvature - 0.01) < 1e-12);
    assert.equal(curve.knots.length, 5);
    assert.ok(curve.knots.every((knot) => Math.abs(knot.curvature_in - 0.01) < 1e-12));
    assert.ok(Math.abs(curve.measures().scaleFreeEnergy - (2 * Math.PI) ** 2) < 1e-9);
    assert.equal(curve.inflections().length, 0);
    assert.equal(curve.jumps().length, 5);
    assert.deepEqual(Object.keys(curve.segments[0]), ["length", "kappa"]);
    const { x0, y1 } = curve.boundingBox();
    assert.ok(Math.abs(x0 + 100) < 1e-6 && Math.abs(y1 - 100) < 1e-6);
    const near = curve.nearest(0, 130);
    assert.ok(Math.abs(near.distance - 30) < 1e-3 && near.segment === 1);
  }
});

test("Béziers in every shape", () => {
  const curve = one({ closed: true, knots: [{ x: 0, y: 0, join: "corner" }, { x: 90, y: 10 }, { x: 40, y: 80 }] });
  const path = curve.beziers(0.01);
  assert.match(path.toSVG(), /^M0,0 ?C[-\d., e]+.*Z$/);
  assert.equal(curve.toSVG(0.01), path.toSVG());
  const calls = [];
  const context = new Proxy({}, { get: (_, name) => (...numbers) => calls.push([name, ...numbers]) });
  path.draw(context);
  assert.deepEqual(calls[0], ["moveTo", 0, 0]);
  assert.deepEqual(calls.at(-1), ["closePath"]);
  assert.ok(calls.flat().every((x) => typeof x === "string" || Number.isFinite(x)));
  const done = curve.convert({ accuracy: 0.01, fit: "end-curvature", cuts: "equal-errors", spanKnots: true });
  assert.ok(done instanceof Conversion && done.bound <= 0.01 && done.cubics > 2);
  assert.ok(curve.comb(4).length === 3 * 5 * 5);
});

test("every spline of the catalogue solves, and says what it takes", () => {
  assert.ok(catalogue.length >= 13 && joins.includes("curve-to-terminal"));
  for (const { name, params } of catalogue) {
    const curve = one({ closed: false, knots: circle(7).slice(0, 5) }, { spline: name });
    assert.equal(curve.spline, name);
    assert.ok(curve.beziers().data.every(Number.isFinite), name);
    for (const param of params) {
      assert.ok(param.summary && ["number", "choice", "text"].includes(param.kind), name);
      one({ knots: circle(5) }, { spline: name, params: { [param.name]: param.default } });
    }
  }
});

test("errors have the program's words and hints", () => {
  const wrong = (does, message, hint) =>
    assert.throws(does, (e) => e instanceof FaircurveError && e.message === message && (hint === undefined || e.hint === hint), message);
  const knots = circle(4);
  wrong(() => one({ knots }, { spline: "spirro" }), "there is no spline `spirro`", "did you mean `spiro`?");
  wrong(() => one({ knots }, { spline: "hobby", params: { tension: 0.1 } }), "parameter `tension` of spline `hobby` can't be `0.1`");
  wrong(() => one({ knots: [] }), "contour 0: the contour has no knots", "give it at least one knot, or leave the contour out");
  wrong(() => one({ knots: [{ x: NaN, y: 0 }, ...knots] }), "contour 0: x of knot 0 is not a finite number", "replace NaN and infinities by ordinary numbers");
  wrong(() => one({ knots: [{ x: 0, y: 0, curvature_out: NaN }, ...knots] }), "contour 0: curvature_out of knot 0 is not a finite number");
  wrong(() => one({ knots: [{ x: 0, y: 0, join: "g3" }] }), "contour 0, knot 0: there is no join `g3`");
  wrong(() => one({ knots: [{ x: 0, y: 0, jion: "g2" }] }), "contour 0, knot 0: there is no key `jion` here", "did you mean `join`?");
  wrong(() => one({ knots: [{ x: "0", y: 0 }] }), "contour 0, knot 0: `x` must be a number, not a string");
  const glyphs = [{ contours: [{ knots }] }, { name: "a", layer: "Fore", contours: [{ knots }, { knots: [{ x: 1e99, y: 0 }] }] }];
  wrong(() => solve({ glyphs }), "glyph `a`, layer `Fore`, contour 1: knot 0 lies beyond 1e55 units");
  wrong(() => solve({ glyphs: { a: 1 } }), "`glyphs` must be a list, not an object");
  wrong(() => solve({ glyphs: [{ name: "a" }] }), "glyph `a`, `contours` must be a list, not left out");
  wrong(() => solve({ glyphs: [null] }), "glyph 0, `contours` must be a list, not left out");
  wrong(() => solve({ contours: 5 }), "`contours` must be a list, not a number");
  wrong(() => solve({ contours: [{}] }), "contour 0, `knots` must be a list, not left out");
  wrong(() => solve({}), "the document has neither `glyphs` nor `contours`");
  wrong(() => one({ knots }).convert({ fit: "best" }), "there is no fit `best`");
});

test("what can't be met is relaxed and says why", () => {
  const knots = [{ x: 0, y: 0 }, { x: 1, y: 0 }, { x: 0, y: 1e-3 }, { x: 1, y: 1e-3 }, { x: 0, y: 2e-3 }, { x: 1, y: 2e-3 }];
  const curve = one({ knots: knots.map((knot) => ({ ...knot, join: "g2" })) });
  assert.equal(curve.status, curve.relaxed.length ? "relaxed" : "solved");
  for (const { knot, asked, got, reason } of curve.relaxed) {
    assert.ok(Number.isInteger(knot) && asked && got && reason.length > 20);
  }
  const adapted = one({ knots: circle(5).map((knot) => ({ ...knot, join: "g4" })) }, { spline: "euler" }).adapted;
  assert.deepEqual(adapted[0], { asked: "g4", got: "g2", knot: 1 });
});

test("what has to loop as asked is relaxed at one place or two instead when loops aren't wanted", () => {
  const knots = [[0, 0], [-36, 76], [-51, 215], [-37, 336]].map(([x, y]) => ({ x, y, join: "g4" }));
  const line = { contours: [{ closed: true, knots }] };
  assert.equal(solve(line).contours[0].status, "solved");
  const { relaxed } = solve(line, { noLoops: true }).contours[0];
  assert.ok(relaxed.length === 1 || relaxed.length === 2);
  assert.ok(relaxed.every(({ reason }) => reason.includes("loops between two knots")));
});

test("a live contour follows edits, refuses nonsense, undoes", () => {
  const live = new LiveContour({ closed: true, knots: circle(12) });
  const start = live.snapshot();
  const before = live.beziers(0.01).toSVG();
  live.move(3, 20, 110);
  assert.ok(live.curve.length > 200 * Math.PI);
  live.insert(4, { x: -20, y: 100, join: "corner" });
  live.delete(9);
  live.change(2, { join: "g2", tangent: [-1, 1] });
  assert.equal(live.knots.length, 12);
  assert.ok(live.beziers(0.01).data.every(Number.isFinite));
  const same = solve({ contours: [live.contour] }).contours[0];
  assert.ok(Math.abs(same.length - live.curve.length) < 1e-6);
  live.move(0, NaN, 0);
  assert.throws(() => live.curve, { name: "FaircurveError", message: "x of knot 0 is not a finite number" });
  assert.throws(() => live.move(99, 0, 0), { message: "there is no knot 99" });
  live.move(0, 100, 0);
  live.setSpline({ spline: "euler" });
  live.setClosed(false);
  assert.equal(live.curve.spline, "euler");
  assert.equal(live.curve.closed, false);
  live.restore(start);
  assert.equal(live.beziers(0.01).toSVG(), before);
  live.restore(start);
  live.settle();
  assert.equal(live.contour.knots.length, 12);
});

test("no input gives a path with a NaN", () => {
  let state = 1;
  const random = () => (state = (state * 48271) % 2147483647) / 2147483647;
  const odd = [0, -0, 1e-300, 1e55, -1e55, 1e9, 1e-9, 5e-324];
  for (let i = 0; i < 300; i++) {
    const knots = Array.from({ length: 1 + Math.floor(6 * random()) }, () => ({
      x: random() < 0.2 ? odd[Math.floor(8 * random())] : Math.round(10 * random()),
      y: random() < 0.2 ? odd[Math.floor(8 * random())] : Math.round(10 * random()),
      join: random() < 0.5 ? joins[Math.floor(6 * random())] : undefined,
    }));
    const { name } = catalogue[i % catalogue.length];
    try {
      const path = solve({ spline: name, contours: [{ closed: random() < 0.5, knots }] }, { effort: 0.1 }).contours[0].beziers();
      assert.ok(path.data.every(Number.isFinite), JSON.stringify({ name, knots }));
    } catch (error) {
      assert.ok(error instanceof FaircurveError, `${name} ${JSON.stringify(knots)} ${error}`);
    }
  }
});

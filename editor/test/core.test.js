// Snapping, links, the fairness test, drawing rules, settings.

import assert from "node:assert/strict";
import { test } from "node:test";
import { fromFragment, toFragment } from "../src/core/link.js";
import { EXPONENTS, shuffled, summed } from "../src/core/fairness_test.js";
import { DEFAULTS, Settings } from "../src/core/settings.js";
import { snapped } from "../src/core/snap.js";
import { Editor } from "../src/core/editor.js";
import { Selection } from "../src/core/selection.js";
import { activeEnd, meeting, placing } from "../src/tools/draw.js";
import { frameMap } from "../src/view/frame.js";
import { apply } from "../src/core/geometry.js";
import { Viewport } from "../src/view/viewport.js";

const around = { knots: [{ x: 100, y: 50 }], extrema: [{ x: 7, y: 300 }], grid: 10 };

test("a point snaps to the nearest line of each axis, and else to the grid", () => {
  const on = { knots: true, extrema: false, axes: true, grid: true };
  const { point, lines } = snapped({ x: 98, y: 203 }, around, on, 5);
  assert.deepEqual(point, { x: 100, y: 200 });
  assert.deepEqual(lines.map(({ axis, value }) => [axis, value]), [["x", 100]]);
  assert.deepEqual(snapped({ x: 8, y: 297 }, around, { extrema: true }, 5).point, { x: 7, y: 300 });
  assert.deepEqual(snapped({ x: 8.25, y: 297.5 }, around, {}, 5).point, { x: 8.25, y: 297.5 });
});

test("a link holds the drawing, and nothing but one", async () => {
  /** @type {import("../src/core/document.js").Document} */
  const document = { spline: "euler", params: { end: "arc" }, glyphs: [{ name: "ä", layer: "", contours: [{ closed: true, knots: Array.from({ length: 60 }, (_, i) => ({ x: i * 13 % 97, y: i * i % 89 })) }] }] };
  const fragment = await toFragment(document);
  assert.match(fragment, /^#d=[A-Za-z0-9_-]+$/);
  assert.ok(fragment.length < 900, `${fragment.length} characters`);
  assert.deepEqual(JSON.parse((await fromFragment(fragment)) ?? ""), { faircurve: 1, ...document });
  assert.equal(await fromFragment("#other"), null);
  assert.equal(await fromFragment(""), null);
  await assert.rejects(fromFragment(fragment.slice(0, -9)), /damaged/);
  await assert.rejects(fromFragment("#d=***"), /damaged/);
});

test("a small link can't unfold to fill the memory", async () => {
  const zeros = new Uint8Array(30e6);
  const packed = await new Response(new Blob([zeros]).stream().pipeThrough(new CompressionStream("deflate-raw"))).arrayBuffer();
  const text = Buffer.from(packed).toString("base64url");
  await assert.rejects(fromFragment(`#d=${text}`), /damaged/);
});

test("the fairness test shows every exponent once, in all orders", () => {
  const first = new Set();
  for (let i = 0; i < 400; i++) {
    const order = shuffled();
    assert.deepEqual(order.toSorted((a, b) => a - b), EXPONENTS);
    first.add(order[0]);
  }
  assert.equal(first.size, EXPONENTS.length);
  const { votes, count, mean } = summed([{ alpha: 1.8, at: "" }, { alpha: 1.2, at: "" }, { alpha: 99, at: "" }]);
  assert.equal(count, 2);
  assert.equal(mean, 1.5);
  assert.equal(votes.reduce((sum, { count }) => sum + count, 0), 2);
  assert.equal(summed([]).mean, null);
});

test("settings outlive a session, and what is damaged in the store is left out", () => {
  const kept = new Map();
  const storage = { getItem: (/** @type {string} */ key) => kept.get(key) ?? null, setItem: (/** @type {string} */ key, /** @type {string} */ value) => void kept.set(key, value) };
  new Settings(storage).set({ grid: 25 });
  assert.equal(new Settings(storage).values.grid, 25);
  kept.set("faircurve.settings", '{"grid":"wide","comb":90,"compare":{}}');
  assert.deepEqual(new Settings(storage).values, { ...DEFAULTS, comb: 90 });
  kept.set("faircurve.settings", "{");
  assert.deepEqual(new Settings(storage).values, DEFAULTS);
});

test("drawing goes on at the selected end; other ends close and join", () => {
  const editor = new Editor();
  assert.deepEqual(placing(editor.state, { x: 0, y: 0 })[0], "startContour");
  editor.run("startContour", { knot: { x: 0, y: 0 } });
  editor.run(...placing(editor.state, { x: 1, y: 0 }));
  assert.equal(meeting(editor.state, { contour: 0, knot: 0 }), null, "two knots don't close");
  editor.run(...placing(editor.state, { x: 1, y: 1 }));
  assert.deepEqual(activeEnd(editor.state), { contour: 0, atStart: false });
  assert.deepEqual(meeting(editor.state, { contour: 0, knot: 0 }), ["close", { contour: 0, closed: true }]);
  assert.equal(meeting(editor.state, { contour: 0, knot: 1 }), null);
  editor.select(Selection.one(0, 0));
  editor.run(...placing(editor.state, { x: -1, y: 0 }));
  assert.deepEqual(editor.contours[0].knots.map(({ x }) => x), [-1, 0, 1, 1]);
  editor.select(Selection.none);
  editor.run(...placing(editor.state, { x: 9, y: 9 }));
  assert.equal(meeting(editor.state, { contour: 0, knot: 3 })?.[0], "joinContours");
});

test("the frame's handles scale about the other side and turn about the centre", () => {
  const box = { x0: 0, y0: 0, x1: 10, y1: 20 };
  const corner = { kind: /** @type {const} */ ("scale"), sx: 1, sy: 1, x: 0, y: 0, cursor: "" };
  const map = frameMap(corner, box, { x: 10, y: 20 }, { x: 20, y: 30 }, { even: false, fromCentre: false });
  assert.deepEqual(apply(map, { x: 10, y: 20 }), { x: 20, y: 30 });
  assert.deepEqual(apply(map, { x: 0, y: 0 }), { x: 0, y: 0 });
  const turn = frameMap({ ...corner, kind: "rotate" }, box, { x: 5, y: 30 }, { x: -15, y: 10 }, { even: true, fromCentre: false });
  const top = apply(turn, { x: 5, y: 20 });
  assert.ok(Math.hypot(top.x + 5, top.y - 10) < 1e-9);
});

test("zooming leaves the point under the pointer where it is", () => {
  const viewport = new Viewport();
  [viewport.width, viewport.height] = [800, 600];
  viewport.fit({ x0: 0, y0: -200, x1: 500, y1: 700 });
  const at = { x: 123, y: 456 };
  const before = viewport.toDrawing(at);
  viewport.zoom(3.7, at);
  const after = viewport.toDrawing(at);
  assert.ok(Math.hypot(before.x - after.x, before.y - after.y) < 1e-9);
});

// The document core: commands, undo, selection.

import assert from "node:assert/strict";
import { test } from "node:test";
import { blank, fromJson, toJson, toText } from "../src/core/document.js";
import { Editor } from "../src/core/editor.js";
import { rotation, scaling } from "../src/core/geometry.js";
import { Selection } from "../src/core/selection.js";
import { reversed } from "../src/core/commands.js";
import { JOINS, joinInfo } from "../src/core/joins.js";

/** An editor with a square of corners. */
function square() {
  const editor = new Editor();
  editor.run("startContour", { knot: { x: 0, y: 0, join: "corner" } });
  for (const [x, y] of [[10, 0], [10, 10], [0, 10]]) editor.run("addKnot", { contour: 0, knot: { x, y, join: "corner" } });
  editor.run("close", { contour: 0, closed: true });
  return editor;
}

const points = (/** @type {Editor} */ editor, contour = 0) => editor.contours[contour].knots.map(({ x, y }) => [x, y]);

test("knots are added at both ends, inserted and deleted", () => {
  const editor = new Editor();
  editor.run("startContour", { knot: { x: 0, y: 0 } });
  editor.run("addKnot", { contour: 0, knot: { x: 2, y: 0 } });
  editor.run("addKnot", { contour: 0, atStart: true, knot: { x: -2, y: 0 } });
  editor.run("insertKnot", { contour: 0, index: 2, knot: { x: 1, y: 1 } });
  assert.deepEqual(points(editor), [[-2, 0], [0, 0], [1, 1], [2, 0]]);
  assert.deepEqual(editor.selection.only, { contour: 0, knot: 2 });
  editor.run("delete");
  assert.deepEqual(points(editor), [[-2, 0], [0, 0], [2, 0]]);
  editor.select(Selection.of([0, 1, 2].map((knot) => ({ contour: 0, knot }))));
  editor.run("delete");
  assert.deepEqual(editor.contours, []);
});

test("undo and redo bring every state back, with what was selected, without a limit", () => {
  const editor = new Editor();
  editor.run("startContour", { knot: { x: 0, y: 0 } });
  const states = [editor.state];
  for (let i = 1; i <= 2000; i++) {
    editor.run("addKnot", { contour: 0, knot: { x: i, y: i % 7 } });
    states.push(editor.state);
  }
  for (let i = 1999; i >= 0; i--) {
    assert.ok(editor.undo());
    assert.equal(editor.state, states[i]);
  }
  for (let i = 1; i <= 2000; i++) {
    assert.ok(editor.redo());
    assert.equal(editor.state, states[i]);
  }
  assert.ok(!editor.redo());
});

test("a new change forgets what could be redone", () => {
  const editor = square();
  editor.undo();
  editor.run("close", { contour: 0, closed: true });
  assert.equal(editor.redoLabel, undefined);
  assert.equal(editor.undoLabel, "close contour");
});

test("changes with one word are undone together, until something else comes between", () => {
  const editor = square();
  editor.select(Selection.one(0, 0));
  for (let i = 0; i < 5; i++) editor.run("move", { dx: 1, dy: 0 }, "nudge");
  editor.select(Selection.one(0, 0));
  editor.run("move", { dx: 1, dy: 0 }, "nudge");
  assert.equal(points(editor)[0][0], 6);
  editor.undo();
  assert.equal(points(editor)[0][0], 5);
  editor.undo();
  assert.equal(points(editor)[0][0], 0);
});

test("a preview is seen and not kept, until it is committed", () => {
  const editor = square();
  editor.select(Selection.one(0, 2));
  const before = editor.committed;
  editor.preview([["move", { dx: 5, dy: 5 }]]);
  editor.preview([["move", { dx: 7, dy: 7 }]]);
  assert.deepEqual(points(editor)[2], [17, 17]);
  assert.equal(editor.committed, before);
  editor.cancel();
  assert.equal(editor.state, before);
  editor.preview([["move", { dx: 3, dy: 3 }]]);
  editor.commit();
  assert.deepEqual(points(editor)[2], [13, 13]);
  assert.equal(editor.undoLabel, "move");
  editor.undo();
  assert.deepEqual(points(editor)[2], [10, 10]);
});

test("contours that a command doesn't touch stay the same objects", () => {
  const editor = square();
  editor.run("startContour", { knot: { x: 50, y: 50 } });
  const [first] = editor.contours;
  editor.run("move", { dx: 1, dy: 1 });
  assert.equal(editor.contours[0], first);
});

test("tangents and curvatures follow rotations, scalings and mirrors", () => {
  const editor = new Editor();
  editor.run("startContour", { knot: { x: 10, y: 0, tangent_in: [1, 0], tangent_out: [1, 0], curvature_in: 0.5 } });
  editor.run("transform", { map: rotation({ x: 0, y: 0 }, Math.PI / 2) });
  let [knot] = editor.contours[0].knots;
  assert.deepEqual([knot.x, knot.y], [0, 10]);
  assert.ok(Math.abs(/** @type {number[]} */ (knot.tangent_in)[1] - 1) < 1e-12);
  assert.ok(Math.abs(/** @type {number} */ (knot.curvature_in) - 0.5) < 1e-12);
  editor.run("transform", { map: scaling({ x: 0, y: 0 }, -2, 2) });
  [knot] = editor.contours[0].knots;
  assert.deepEqual([knot.x, knot.y], [0, 20]);
  assert.equal(knot.curvature_in, -0.25);
  const before = editor.state;
  editor.run("transform", { map: scaling({ x: 0, y: 0 }, 0, 1) });
  assert.equal(editor.state, before, "a map that lays knots on one another is refused");
});

test("reversing twice gives the contour back, and turns what belongs to a side", () => {
  const contour = {
    closed: false,
    knots: [
      { x: 0, y: 0, join: /** @type {const} */ ("curve-to-terminal"), curvature_in: 0.1, tension_out: 2 },
      { x: 1, y: 0, tangent_out: /** @type {[number, number]} */ ([1, 2]) },
    ],
  };
  const once = reversed(contour);
  assert.deepEqual(once.knots[1], { x: 0, y: 0, join: "terminal-to-curve", curvature_out: -0.1, tension_in: 2 });
  assert.deepEqual(once.knots[0], { x: 1, y: 0, tangent_in: [-1, -2] });
  assert.deepEqual(reversed(once), contour);
});

test("open contours are joined end to end, whichever ends they are", () => {
  for (const atStart of [false, true]) {
    for (const otherAtStart of [false, true]) {
      const editor = new Editor();
      editor.run("startContour", { knot: { x: 0, y: 0 } });
      editor.run("addKnot", { contour: 0, knot: { x: 1, y: 0 } });
      editor.run("startContour", { knot: { x: 2, y: 0 } });
      editor.run("addKnot", { contour: 1, knot: { x: 3, y: 0 } });
      editor.run("joinContours", { contour: 1, atStart, other: 0, otherAtStart });
      const first = atStart ? [3, 2] : [2, 3];
      const second = otherAtStart ? [0, 1] : [1, 0];
      assert.deepEqual(points(editor).map(([x]) => x), [...first, ...second]);
      assert.equal(editor.contours.length, 1);
    }
  }
});

test("a closed contour is cut open at a knot, which there are two of then", () => {
  const editor = square();
  editor.run("openAt", { contour: 0, knot: 2 });
  assert.deepEqual(points(editor), [[10, 10], [0, 10], [0, 0], [10, 0], [10, 10]]);
  assert.equal(editor.contours[0].closed, false);
});

test("aligning and distributing move along one axis only", () => {
  const editor = new Editor();
  editor.run("startContour", { knot: { x: 0, y: 0 } });
  for (const [x, y] of [[9, 5], [2, 30]]) editor.run("addKnot", { contour: 0, knot: { x, y } });
  editor.select(Selection.of([0, 1, 2].map((knot) => ({ contour: 0, knot }))));
  editor.run("distribute", { axis: "y" });
  assert.deepEqual(points(editor), [[0, 0], [9, 15], [2, 30]]);
  editor.run("align", { edge: "right" });
  assert.deepEqual(points(editor), [[9, 0], [9, 15], [9, 30]]);
});

test("the table of joins: a double click comes around, reversing twice is nothing, keys differ", () => {
  assert.equal(new Set(JOINS.map(({ key }) => key)).size, JOINS.length);
  for (const { join, reversed } of JOINS) {
    assert.equal(joinInfo(reversed).reversed, join);
    let at = join;
    const seen = new Set();
    while (!seen.has(at)) {
      seen.add(at);
      at = joinInfo(at).next;
    }
    assert.ok(seen.size >= 2, `${join} leads nowhere`);
  }
});

test("a document is the same after its text", () => {
  const editor = square();
  editor.run("setKnot", { fields: { tangent_in: [1, 2], curl: 1 } });
  const { document } = editor.state;
  const text = toText(document);
  assert.deepEqual(fromJson(JSON.parse(text)), document);
  assert.deepEqual(JSON.parse(text), JSON.parse(JSON.stringify(toJson(document))));
  assert.match(text, /\{"x": 10, "y": 0, "join": "corner"\}/);
  assert.deepEqual(fromJson({ faircurve: 1, contours: [{ knots: [{ x: 0, y: 0, tangent: [1, 0] }] }] }).glyphs[0].contours[0], {
    closed: false, knots: [{ x: 0, y: 0, tangent_in: [1, 0], tangent_out: [1, 0] }],
  });
  assert.equal(blank().glyphs.length, 1);
});

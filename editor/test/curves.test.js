// The editor over the real package: needs it built (`cargo xtask npm`).

import assert from "node:assert/strict";
import { readFile as readBytes } from "node:fs/promises";
import { test } from "node:test";
import { packageCurves } from "../src/curves/curves.js";
import { CurveStore } from "../src/curves/store.js";
import { isWritable, readFile, writeFile, writePath, writeSvg } from "../src/curves/files.js";
import { Editor } from "../src/core/editor.js";
import { Selection } from "../src/core/selection.js";
import { EXAMPLES } from "../src/examples.js";
import { toText } from "../src/core/document.js";

test("every example is solved as asked, and reads back from its own text", async () => {
  for (const { name, document } of EXAMPLES) {
    const store = new CurveStore(packageCurves);
    for (const contour of document.glyphs[0].contours) assert.deepEqual(store.canonical(contour, document).relaxed, [], name);
    assert.deepEqual(await readFile(toText(document), "json"), document);
  }
});

test("a curve in the hand ends where the kept one is", () => {
  const editor = new Editor();
  const store = new CurveStore(packageCurves);
  editor.run("open", { document: EXAMPLES[0].document });
  editor.select(Selection.one(0, 1));
  for (let i = 1; i <= 20; i++) {
    editor.preview([["move", { dx: i, dy: -i }]]);
    store.seen(editor);
  }
  const [inHand] = store.seen(editor);
  const { length } = inHand;
  editor.commit();
  const [kept] = store.seen(editor);
  assert.ok(inHand.isGone && !kept.isGone, "what was in the hand gives its memory back");
  assert.ok(Math.abs(length - kept.length) < 1e-6 * kept.length);
  editor.undo();
  assert.equal(store.seen(editor)[0], store.canonical(EXAMPLES[0].document.glyphs[0].contours[0], EXAMPLES[0].document));
});

test("a G4 knot on a curve of spiro leaves the curve as it is", () => {
  const [contour] = EXAMPLES[0].document.glyphs[0].contours;
  const choice = { spline: "spiro", params: {} };
  const before = packageCurves.solve(contour, choice);
  const at = before.at((before.knotPlaces[1] + before.knotPlaces[2]) / 2);
  assert.ok(at);
  const knots = contour.knots.toSpliced(2, 0, { x: at.x, y: at.y, join: "g4" });
  const after = packageCurves.solve({ ...contour, knots }, choice);
  assert.ok(Math.abs(after.length - before.length) < 1e-6);
  assert.ok(Math.abs(after.measures.bendingEnergy - before.measures.bendingEnergy) < 1e-6 * before.measures.bendingEnergy);
});

test("previewed knots come and go", () => {
  const editor = new Editor();
  const store = new CurveStore(packageCurves);
  editor.run("startContour", { knot: { x: 0, y: 0 } });
  editor.run("addKnot", { contour: 0, knot: { x: 100, y: 0 } });
  for (const y of [50, 60, 70]) {
    editor.preview([["addKnot", { contour: 0, knot: { x: 200, y } }]]);
    const [curve] = store.seen(editor);
    assert.equal(curve.knots.length, 3);
    assert.equal(curve.knots[2].y, y);
    assert.ok(curve.beziers(0.1).cubics >= 2);
  }
  editor.cancel();
  assert.equal(store.seen(editor)[0].knots.length, 2);
});

test("every contour of the empty kind is drawn without complaint", () => {
  for (const knots of [[{ x: 1, y: 1 }], [{ x: 1, y: 1 }, { x: 1, y: 1 }]]) {
    for (const closed of [false, true]) {
      const curve = packageCurves.solve({ closed, knots }, { spline: "spiro", params: {} });
      assert.ok(curve.length === 0);
      assert.equal(curve.typicalCurvature, 0);
      assert.ok((curve.nearest({ x: 0, y: 0 })?.distance ?? 0) >= 0);
      curve.beziers(0.1);
    }
  }
});

test("files: what can be read, what can be written, what is damaged", async () => {
  const sfd = await readBytes(new URL("../../examples/comma.sfd", import.meta.url));
  const document = await readFile(sfd, "comma.sfd");
  assert.ok(document.glyphs.length > 0);
  assert.equal(await isWritable("a.json"), true);
  assert.equal(await isWritable("a.sfd"), false);
  assert.deepEqual(await readFile(await writeFile(document, "a.json"), "a.json"), document);
  assert.match(await writeSvg(document, 0.1), /<svg fill-rule="evenodd" .*<path/s);
  assert.match(await writePath(document, 0.1), /^M/);
  await assert.rejects(readFile('{"faircurve": 1, "contours": [{"knots": [{"x": 0}]}]}', "a.json"), (/** @type {any} */ error) => /`y`/.test(error.message));
  await assert.rejects(readFile("nonsense", "a.json"));
});

test("what has no meaning in the hand is drawn straight, says why, and can be dragged out of it", () => {
  const editor = new Editor();
  const store = new CurveStore(packageCurves);
  editor.run("open", { document: EXAMPLES[2].document });
  editor.select(Selection.one(0, 2));
  for (const dx of [1, 1e300, 2, 1e300, 1e300, 3]) {
    editor.preview([["move", { dx, dy: 0 }]]);
    const [curve] = store.seen(editor);
    assert.equal(curve.spline, dx > 10 ? "polygon" : "euler");
    assert.equal(curve.relaxed.length > 0, dx > 10);
  }
  editor.commit();
  assert.equal(store.seen(editor)[0].spline, "euler");
});

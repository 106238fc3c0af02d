// The formats, and the Node example.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { FaircurveError, solve } from "faircurve";
import { formats, path, read, solution, svg, write } from "faircurve/formats";

const file = (name) => readFileSync(join(process.env.FAIRCURVE_ROOT, "examples", name));

test("every example reads, and writes back the same", () => {
  assert.ok(formats.some(({ name, writes }) => name === "json" && writes));
  for (const name of ["a.json", "joins.json", "circle.csv", "comma.sfd"]) {
    const document = read(file(name), name);
    assert.deepEqual(read(write(document, "json"), "json"), document);
    assert.ok(solve(document).contours.every((curve) => curve.beziers().data.every(Number.isFinite)));
  }
  assert.equal(read("0,0\n1,2,corner\n", "csv").glyphs[0].contours[0].knots[1].join, "corner");
});

test("what is written is the solution", () => {
  const document = read(file("a.json"), "a.json");
  const numbers = JSON.parse(solution(document, { samples: 2 }));
  const curves = solve(document).contours;
  numbers.glyphs[0].contours.forEach((contour, i) => {
    assert.equal(contour.length, curves[i].length);
    assert.equal(contour.segments[0].samples.length, 3);
  });
  assert.match(svg(document, { knots: true, comb: true }), /^<svg [^]*<\/svg>\n$/);
  assert.match(path(document, { accuracy: 1 }), /^M.*Z\n$/);
});

test("errors have their place", () => {
  assert.throws(
    () => read("0,0\n10,1o\n", "a.csv"),
    (e) => e instanceof FaircurveError && e.message === "a.csv:2:4: contour 0, knot 1: `1o` is not a number" && e.location.line === 2,
  );
  assert.throws(() => read("", "a.xyz"), { name: "FaircurveError", message: "no input format has the extension `xyz`" });
  assert.throws(() => write(read("0,0", "csv"), "sfd"), { message: "format `sfd` is read, but not written" });
});

test("the Node example runs", () => {
  const example = (name) => spawnSync("node", ["examples/node.js", name, "out.svg"], { encoding: "utf8" });
  const done = example(join(process.env.FAIRCURVE_ROOT, "examples/a.json"));
  assert.equal(done.status, 0, done.stderr);
  assert.match(done.stdout, /^spiro: solved, length [\d.]+, \d+ inflections/);
  assert.match(readFileSync("out.svg", "utf8"), /^<svg/);
  assert.equal(execFileSync("node", ["-e", 'import("faircurve").then((f) => console.log(f.joins.length))'], { encoding: "utf8" }), "6\n");
});

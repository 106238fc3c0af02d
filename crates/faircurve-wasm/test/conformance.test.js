// The cases that every way into faircurve agrees on, through both modules: conformance/README.md.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { solve } from "faircurve";
import "faircurve/splines";
import { solution } from "faircurve/formats";

const folder = join(process.env.FAIRCURVE_ROOT, "conformance/cases");
const cases = readdirSync(folder).map((name) => [name, JSON.parse(readFileSync(join(folder, name), "utf8"))]);

/** Units in which the numbers of a contour are compared. */
function unitsOf({ knots, segments }) {
  const most = (numbers) => numbers.reduce((most, x) => Math.max(most, Math.abs(x ?? 0)), 0);
  const coordinate = most(knots.flatMap(({ x, y }) => [x, y]));
  const samples = segments.flatMap((segment) => (segment.samples ?? []).map((row) => row[4]));
  const curvature = most([...knots.flatMap((knot) => [knot.curvature_in, knot.curvature_out]), ...samples]);
  const kappa = Math.max(1, most(segments.flatMap((segment) => segment.kappa ?? [])));
  return { coordinate, curvature, kappa };
}

function unit(key, column, units) {
  if (["x", "y", "length"].includes(key) || (key === "samples" && column < 3)) return units.coordinate;
  if (key.startsWith("direction") || (key === "samples" && column === 3)) return 1;
  if (key.startsWith("curvature") || key === "samples") return units.curvature;
  if (key === "kappa") return units.kappa;
  if (key === "variation_energy") return units.curvature ** 3;
  return 0;
}

/** Calls `differs` with each place where `a` isn't `b`; counts numbers. */
function compare(a, b, key, column, units, differs) {
  if (typeof a === "number" && typeof b === "number") {
    const within = 1e-12 * Math.max(Math.abs(a), Math.abs(b), unit(key, column, units));
    if (!(Math.abs(a - b) <= within)) differs(`${key}: ${a} ${b}`);
    return 1;
  }
  if (Array.isArray(a) && Array.isArray(b) && a.length === b.length) {
    const each = (item, i) => compare(item, b[i], key, i, key === "contours" ? unitsOf(b[i]) : units, differs);
    return a.map(each).reduce((sum, n) => sum + n, 0);
  }
  if (a && b && typeof a === "object" && typeof b === "object") {
    const keys = Object.keys(b).filter((name) => !["iterations", "residual", "path"].includes(name));
    return keys.map((name) => compare(a[name], b[name], name, 0, units, differs)).reduce((sum, n) => sum + n, 0);
  }
  if (a !== b) differs(`${key}: ${JSON.stringify(a)} ${JSON.stringify(b)}`);
  return 0;
}

/** What the solver module says, in the shape of a solution. */
function solved(document, samples) {
  const glyphs = solve(document).glyphs.map(({ name, layer, contours }) => ({
    name,
    layer,
    contours: contours.map((curve) => {
      const { spline, closed, status, relaxed, adapted, knots, length } = curve;
      const rows = curve.comb(samples);
      let [row, before] = [0, 0];
      const segments = curve.segments.map((segment) => {
        if (segment.length === 0) return undefined;
        const own = Array.from({ length: samples + 1 }, () => [...rows.subarray(5 * row, 5 * ++row)]);
        own.forEach((sample) => (sample[0] -= before));
        before += segment.length;
        return { ...segment, samples: own };
      });
      const { bendingEnergy, variationEnergy } = curve.measures();
      return {
        spline, closed, status, relaxed, adapted, knots, segments, length,
        bending_energy: bendingEnergy, variation_energy: variationEnergy,
      };
    }),
  }));
  return { faircurve: 1, glyphs };
}

for (const [name, { document, samples, solution: expected }] of cases) {
  test(`conformance: ${name}`, () => {
    const off = [];
    const numbers = compare(JSON.parse(solution(document, { samples })), expected, "", 0, {}, (place) => off.push(place));
    // The solver module has no samples for segments of length 0.
    const less = structuredClone(expected);
    const own = solved(document, samples);
    own.glyphs.forEach((glyph, g) =>
      glyph.contours.forEach((contour, c) =>
        contour.segments.forEach((segment, s) => segment ?? (contour.segments[s] = less.glyphs[g].contours[c].segments[s])),
      ),
    );
    compare(own, less, "", 0, {}, (place) => off.push(`solver: ${place}`));
    assert.deepEqual(off.slice(0, 10), []);
    assert.ok(numbers > 0);
  });
}

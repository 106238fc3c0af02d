/**
 * Fair curves through points.
 *
 * ```js
 * import { solve } from "faircurve";
 * const { contours } = solve({ contours: [{ closed: true, knots: [{ x: 0, y: 0 }, { x: 9, y: 0 }, { x: 5, y: 7 }] }] });
 * console.log(contours[0].toSVG());
 * ```
 * @module
 */
import { Curve } from "./curve.js";
import { checked, FaircurveError } from "./error.js";
import type { Contour, Document, Glyph, Join, SplineChoice } from "./document.js";
import { knotRows, splineOf, wrongType } from "./knots.js";
import { wasm } from "./solver.js";

export { catalogue, type ParamSpec, type SplineInfo } from "./catalogue.js";
export { Beziers, Conversion, type BezierOptions, type PathContext } from "./beziers.js";
export {
  Curve,
  type Adaptation,
  type CurvePoint,
  type Jump,
  type Measures,
  type Relaxation,
  type SolvedKnot,
  type SolvedSegment,
} from "./curve.js";
export type { Contour, Document, Glyph, Join, Knot, Params, SplineChoice, Vector } from "./document.js";
export { FaircurveError, type Location } from "./error.js";
export { LiveContour, Snapshot } from "./live.js";
/** @internal */
export { addSplines } from "./solver.js";

/** How to solve. */
export interface SolveOptions {
  /** How far to search for hard contours before relaxing, times the default; 1 is at most about 50 ms a contour. */
  effort?: number;
  /**
   * Whether, where every curve as asked that was found loops (a segment is longer than four chords), one knot or two
   * are relaxed instead if that gives a curve without; left out: no. The curve's `relaxed` says where.
   */
  noLoops?: boolean;
}

/** A solved glyph. */
export interface SolvedGlyph {
  /** Empty for an unnamed one. */
  name: string;
  /** Empty where there are no layers. */
  layer: string;
  /** The curves, in the order of the contours. */
  contours: Curve[];
}

/** A solved document. */
export interface Solution {
  glyphs: SolvedGlyph[];
  /** The curves of all glyphs, in order. */
  contours: Curve[];
}

/**
 * Finds the curve of every contour: a function of the document alone.
 *
 * Throws a {@link FaircurveError} where something has no meaning, or where a spline's module isn't loaded: all but
 * `spiro`, `euler` and `hobby` need `import "faircurve/splines"`. What can't be solved as asked is no error: the
 * curve's `status` is `relaxed` and it says what and why.
 */
export function solve(document: Document, options: SolveOptions = {}): Solution {
  if (typeof document !== "object" || document === null) throw wrongType("the document", "an object", document);
  const { faircurve, glyphs, contours } = document;
  if (faircurve !== undefined && faircurve !== 1) {
    throw new FaircurveError(`version ${String(faircurve)} is unknown`, "this program reads version 1");
  }
  if (glyphs !== undefined && contours !== undefined) {
    throw new FaircurveError("the document has both `glyphs` and `contours`", "move these contours into a glyph");
  }
  const all = glyphs ?? (contours && [{ contours }]);
  if (all === undefined) {
    throw new FaircurveError("the document has neither `glyphs` nor `contours`", 'add `"contours": […]`');
  }
  if (!Array.isArray(all)) throw wrongType("`glyphs`", "a list", all);
  const solved: SolvedGlyph[] = [];
  const curves: Curve[] = [];
  for (let index = 0; index < all.length; index++) {
    const glyph = solveGlyph(all[index]!, () => (glyphs ? glyphPlace(all[index]!, index) : ""), document, options);
    solved.push(glyph);
    for (const curve of glyph.contours) curves.push(curve);
  }
  return { glyphs: solved, contours: curves };
}

function glyphPlace(glyph: Glyph | undefined, index: number): string {
  const { name, layer } = glyph ?? {};
  return `${name ? `glyph \`${name}\`` : `glyph ${index}`}, ${layer ? `layer \`${layer}\`, ` : ""}`;
}

/** `place`, where the words that say it are wanted. */
function solveGlyph(glyph: Glyph, place: () => string, document: Document, options: SolveOptions): SolvedGlyph {
  if (!Array.isArray(glyph?.contours)) throw wrongType(`${place()}\`contours\``, "a list", glyph?.contours);
  const contours: Curve[] = [];
  for (let index = 0; index < glyph.contours.length; index++) {
    const at = () => `${place()}contour ${index}`;
    contours.push(solveContour(glyph.contours[index]!, document, options, at));
  }
  return { name: glyph.name ?? "", layer: glyph.layer ?? "", contours };
}

/**
 * The curve of one contour; its errors begin with the place, where there is more than this one.
 * @internal
 */
export function solveContour(
  contour: Contour,
  otherwise: SplineChoice = {},
  options: SolveOptions = {},
  place?: () => string,
): Curve {
  if (!Array.isArray(contour?.knots)) throw wrongType(`${place ? `${place()}, ` : ""}\`knots\``, "a list", contour?.knots);
  const { name, built, solver } = checked(() => splineOf(contour, otherwise));
  const rows = knotRows(contour.knots, place);
  const { closed = false } = contour;
  const { effort = 1, noLoops = false } = options;
  return new Curve(checked(() => solver.solve(built, rows, closed, effort, noLoops), place), name, closed);
}

/** The names of the joins. */
export const joins: readonly Join[] = wasm.joins() as Join[];

// The one place that knows the package `faircurve`. Everything that is solved, measured or converted comes from
// it; the editor solves nothing by itself.

import * as faircurve from "faircurve";
import "faircurve/splines";

/** @typedef {import("../core/document.js").Contour} Contour */
/** @typedef {import("../core/document.js").Choice} Choice */
/** @typedef {import("../core/document.js").Join} Join */
/** @typedef {import("../core/geometry.js").Point} Point */
/** @typedef {{command: "move" | "line" | "quad" | "cubic" | "close", points: Point[]}} Element */
/** @typedef {{knot?: number, segment?: number, asked: string, got: string, reason?: string}} Place */
/** @typedef {{s: number, x: number, y: number, segment: number, distance: number}} Nearest */

/** Steps a segment for combs and plots: fine enough that the rim of a comb looks smooth; fewer where there are many segments, which are short then. */
const COMB_STEPS = { most: 18, least: 5, ofAll: 1500 };
const COMMANDS = /** @type {const} */ (["move", "line", "quad", "cubic", "close"]);
const POINTS = [1, 1, 2, 3, 0];

export const catalogue = faircurve.catalogue;

/**
 * Splines whose segments are neither spirals nor Béziers: converting them takes longer than a frame, so they
 * are drawn through close samples, and their Béziers are found only where they are asked for.
 */
const SLOWLY_CONVERTED = new Set(["generated", "circle"]);

/** @param {string} name */
export const splineInfo = (name) => catalogue.find((info) => info.name === name);

/** A solved contour; what isn't asked for isn't computed, what was is kept. */
export class Solved {
  #curve;
  #beziersNow;
  /** @type {Map<number, Path2D>} */
  #paths = new Map();
  /** @type {Map<number, ReturnType<Solved["convert"]>>} */
  #converted = new Map();
  /** @type {Map<string, unknown>} */
  #known = new Map();

  /**
   * @param {faircurve.Curve} curve
   * @param {(accuracy: number) => faircurve.Beziers} [beziersNow] what is quicker than converting all of it
   */
  constructor(curve, beziersNow) {
    this.#curve = curve;
    this.#beziersNow = beziersNow;
  }

  /** @template T @param {string} name @param {() => T} find @returns {T} */
  #once(name, find) {
    if (!this.#known.has(name)) this.#known.set(name, find());
    return /** @type {T} */ (this.#known.get(name));
  }

  /** The contour in the hand has moved on: nothing can be asked any more, and the memory is given back. */
  letGo() {
    if (this.isGone) return;
    this.isGone = true;
    this.#beziersNow = undefined;
    this.#curve.free();
  }

  isGone = false;

  get spline() {
    return this.#curve.spline;
  }

  /** What could not be met, and why. @returns {readonly Place[]} */
  get relaxed() {
    return this.#once("relaxed", () => (this.#curve.status === "relaxed" ? this.#curve.relaxed : []));
  }

  /** The curve isn't what was asked for at all. @param {Place} place */
  refuse(place) {
    this.#known.set("relaxed", [place]);
  }

  /** What the spline doesn't have. @returns {readonly Place[]} */
  get adapted() {
    return this.#once("adapted", () => this.#curve.adapted);
  }

  get knots() {
    return this.#once("knots", () => this.#curve.knots);
  }

  get measures() {
    return this.#once("measures", () => this.#curve.measures());
  }

  get jumps() {
    return this.#once("jumps", () => this.#curve.jumps());
  }

  /** Arc lengths of the knots, and of the first once more where the curve returns to it. @returns {number[]} */
  get knotPlaces() {
    return this.#once("knotPlaces", () => {
      const places = [0];
      for (const { length } of this.#curve.segments) places.push(places[places.length - 1] + length);
      return places;
    });
  }

  get length() {
    return this.#curve.length;
  }

  /** For each segment rows of arc length, x, y, direction, curvature. @returns {Float64Array[]} */
  get comb() {
    return this.#once("comb", () => {
      const steps = Math.max(COMB_STEPS.least, Math.min(COMB_STEPS.most, Math.round(COMB_STEPS.ofAll / Math.max(1, this.knots.length))));
      const all = this.#curve.comb(steps);
      const size = 5 * (steps + 1);
      return Array.from({ length: all.length / size }, (_, i) => all.subarray(i * size, (i + 1) * size));
    });
  }

  /** A curvature that few places exceed, by which combs are scaled: one cusp doesn't flatten all the rest. @returns {number} */
  get typicalCurvature() {
    return this.#once("typical", () => {
      const all = Float64Array.from(this.comb.flatMap((rows) => Array.from({ length: rows.length / 5 }, (_, i) => Math.abs(rows[5 * i + 4])))).sort();
      return all[Math.floor(0.96 * (all.length - 1))] ?? 0;
    });
  }

  get inflections() {
    return this.#once("inflections", () => this.#pointsAt(this.#curve.inflections()));
  }

  get curvatureExtrema() {
    return this.#once("extrema", () => this.#pointsAt(this.#curve.curvatureExtrema()));
  }

  /** Where it is horizontal or vertical. */
  get axisExtrema() {
    return this.#once("axis", () => this.#pointsAt(this.#curve.axisExtrema()));
  }

  /** @param {Float64Array} places @returns {(Point & {s: number})[]} */
  #pointsAt(places) {
    const rows = this.#curve.atMany(places);
    return Array.from(places, (s, i) => ({ s, x: rows[4 * i], y: rows[4 * i + 1] }));
  }

  /** @param {number} s */
  at(s) {
    return this.#curve.at(s);
  }

  /** @returns {import("../core/geometry.js").Box | null} */
  get box() {
    return this.#once("box", () => {
      const box = this.#curve.boundingBox();
      return Number.isFinite(box.x0) ? box : null;
    });
  }

  /** The nearest point of the curve. @param {Point} p @returns {Nearest | null} */
  nearest({ x, y }) {
    const nearest = this.#curve.nearest(x, y, 1e-5 * this.length);
    if (!nearest) return null;
    const s = this.knotPlaces[nearest.segment] + nearest.s;
    const at = this.#curve.at(s);
    return at ? { s, x: at.x, y: at.y, segment: nearest.segment, distance: nearest.distance } : null;
  }

  /** Whether its Béziers can be had within a frame, or are known already. @param {number} accuracy */
  isQuick(accuracy) {
    return !SLOWLY_CONVERTED.has(this.spline) || this.#converted.has(accuracy);
  }

  /** Through close samples, with the curve's own directions there. */
  get #sampledPath() {
    return this.#once("sampled", () => {
      const path = new Path2D();
      for (const [i, rows] of this.comb.entries()) {
        if (i === 0) path.moveTo(rows[1], rows[2]);
        for (let r = 5; r < rows.length; r += 5) {
          const arm = (rows[r] - rows[r - 5]) / 3;
          const [from, to] = [rows[r - 2], rows[r + 3]];
          path.bezierCurveTo(rows[r - 4] + arm * Math.cos(from), rows[r - 3] + arm * Math.sin(from),
            rows[r + 1] - arm * Math.cos(to), rows[r + 2] - arm * Math.sin(to), rows[r + 1], rows[r + 2]);
        }
      }
      if (this.#curve.closed) path.closePath();
      return path;
    });
  }

  /** For the canvas, in drawing units. @param {number} accuracy */
  path2d(accuracy) {
    if (SLOWLY_CONVERTED.has(this.spline)) return this.#sampledPath;
    let path = this.#paths.get(accuracy);
    if (!path) {
      const beziers = this.#beziersNow?.(accuracy) ?? this.#curve.beziers(accuracy);
      this.#paths.set(accuracy, (path = beziers.toPath2D()));
    }
    return path;
  }

  /** The Béziers that are written. @param {number} accuracy */
  beziers(accuracy) {
    let converted = this.#converted.get(accuracy);
    if (!converted) this.#converted.set(accuracy, (converted = this.convert(accuracy)));
    return converted;
  }

  /** @param {number} accuracy */
  convert(accuracy) {
    const { data, bound, cubics, lines } = this.#curve.convert({ accuracy });
    /** @type {Element[]} */
    const elements = [];
    for (let i = 0; i < data.length; i += 1 + 2 * POINTS[data[i]]) {
      const points = Array.from({ length: POINTS[data[i]] }, (_, j) => ({ x: data[i + 1 + 2 * j], y: data[i + 2 + 2 * j] }));
      elements.push({ command: COMMANDS[data[i]], points });
    }
    return { elements, bound, cubics, lines };
  }
}

/** A contour that follows the hand. */
export class Following {
  #live;
  #contour;
  /** @type {Solved | null} */
  #last = null;

  /** @param {Contour} contour @param {Choice} choice */
  constructor(contour, choice) {
    this.#live = new faircurve.LiveContour({ ...contour, ...choice });
    this.#contour = contour;
  }

  /** The curve as it is now. @returns {Solved} */
  solved() {
    return (this.#last = new Solved(this.#live.curve, (accuracy) => this.#live.beziers(accuracy)));
  }

  /**
   * Follows to another state of the contour by the smallest edits: a knot that came or went, then the rest.
   * @param {Contour} contour
   */
  become(contour) {
    this.#last?.letGo();
    const [old, knots] = [this.#contour.knots, contour.knots];
    const change = knots.length - old.length;
    const first = knots.findIndex((knot, i) => knot !== old[i]);
    if (change === 1) this.#live.insert(first < 0 ? old.length : first, knots[first < 0 ? old.length : first]);
    if (change === -1) this.#live.delete(first < 0 ? knots.length : first);
    this.#live.setKnots(knots);
    if (contour.closed !== this.#contour.closed) this.#live.setClosed(contour.closed);
    this.#contour = contour;
    return this.solved();
  }

  free() {
    this.#last?.letGo();
    this.#live.free();
  }
}

/**
 * How many cubics several curves are written with: at once where that is quick, or else bit by bit.
 * @param {readonly Solved[]} curves
 * @param {number} accuracy
 * @param {(count: {cubics: number, lines: number} | null) => void} show `null` while it isn't known
 * @returns {() => void} stops
 */
export function countBeziers(curves, accuracy, show) {
  const missing = curves.filter((curve) => !curve.isQuick(accuracy));
  const tell = () => {
    if (curves.some((curve) => curve.isGone)) return;
    const all = curves.map((curve) => curve.beziers(accuracy));
    show({ cubics: all.reduce((n, b) => n + b.cubics, 0), lines: all.reduce((n, b) => n + b.lines, 0) });
  };
  if (missing.length === 0) {
    tell();
    return () => {};
  }
  show(null);
  let timer = setTimeout(next, 400);
  function next() {
    const curve = missing.pop();
    if (curve && !curve.isGone) curve.beziers(accuracy);
    if (missing.length > 0) timer = setTimeout(next, 30);
    else tell();
  }
  return () => clearTimeout(timer);
}

/**
 * The canonical curve.
 * @param {Contour} contour
 * @param {Choice} choice
 */
function solve(contour, { spline, params }) {
  const { contours } = faircurve.solve({ contours: [{ closed: contour.closed, knots: contour.knots, spline, params }] });
  return new Solved(contours[0]);
}

/** What is drawn where a curve would have no meaning: lines, however large, or a point. @param {Contour} contour */
function straight({ closed, knots }) {
  const within = (/** @type {number} */ x) => Math.max(-1e50, Math.min(1e50, x || 0));
  const plain = knots.map(({ x, y }) => ({ x: within(x), y: within(y) }));
  const polygon = { spline: "polygon", params: {} };
  try {
    return solve({ closed, knots: plain }, polygon);
  } catch {
    return solve({ closed: false, knots: [plain[0] ?? { x: 0, y: 0 }] }, polygon);
  }
}

/** What the curve store needs; tests may bring their own. */
export const packageCurves = {
  /**
   * The canonical curve. Where what is given has no meaning, straight lines, and why.
   * @param {Contour} contour
   * @param {Choice} choice
   */
  solve(contour, choice) {
    try {
      return solve(contour, choice);
    } catch (error) {
      if (!(error instanceof faircurve.FaircurveError)) throw error;
      const lines = straight(contour);
      lines.refuse({ segment: 0, asked: choice.spline, got: "polygon", reason: [error.message, error.hint].filter(Boolean).join("; ") });
      return lines;
    }
  },
  /** @param {Contour} contour @param {Choice} choice */
  follow: (contour, choice) => new Following(contour, choice),
};

/** @typedef {typeof packageCurves} Curves */

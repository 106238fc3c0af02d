// The one place that knows the package `faircurve`. Everything that is solved, measured or converted comes from
// it; the editor solves nothing by itself.

import * as faircurve from "faircurve";

/** @typedef {import("../core/document.js").Contour} Contour */
/** @typedef {import("../core/document.js").Choice} Choice */
/** @typedef {import("../core/document.js").Join} Join */
/** @typedef {import("../core/geometry.js").Point} Point */
/** @typedef {{command: "move" | "line" | "quad" | "cubic" | "close", points: Point[]}} Element */
/** @typedef {{knot?: number, segment?: number, asked: string, got: string, reason?: string}} Place */
/** @typedef {{s: number, x: number, y: number, segment: number, distance: number}} Nearest */

/** Steps a segment for combs and plots: fine enough that the rim of a comb looks smooth. */
const COMB_STEPS = 18;
const COMMANDS = /** @type {const} */ (["move", "line", "quad", "cubic", "close"]);
const POINTS = [1, 1, 2, 3, 0];

export const catalogue = faircurve.catalogue;

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

  /** The contour in the hand has moved on: what is asked from now on is found without it. */
  letGo() {
    this.#beziersNow = undefined;
  }

  get spline() {
    return this.#curve.spline;
  }

  /** What could not be met, and why. @returns {readonly Place[]} */
  get relaxed() {
    return this.#once("relaxed", () => (this.#curve.status === "relaxed" ? this.#curve.relaxed : []));
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
      const all = this.#curve.comb(COMB_STEPS);
      const size = 5 * (COMB_STEPS + 1);
      return Array.from({ length: all.length / size }, (_, i) => all.subarray(i * size, (i + 1) * size));
    });
  }

  /** A curvature that few places exceed, by which combs are scaled: one cusp doesn't flatten all the rest. @returns {number} */
  get typicalCurvature() {
    return this.#once("typical", () => {
      const all = this.comb.flatMap((rows) => Array.from({ length: rows.length / 5 }, (_, i) => Math.abs(rows[5 * i + 4])));
      all.sort((a, b) => a - b);
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

  /** For the canvas, in drawing units. @param {number} accuracy */
  path2d(accuracy) {
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

/** What the curve store needs; tests may bring their own. */
export const packageCurves = {
  /**
   * The canonical curve.
   * @param {Contour} contour
   * @param {Choice} choice
   */
  solve(contour, { spline, params }) {
    const { contours } = faircurve.solve({ contours: [{ closed: contour.closed, knots: contour.knots, spline, params }] });
    return new Solved(contours[0]);
  },
  /** @param {Contour} contour @param {Choice} choice */
  follow: (contour, choice) => new Following(contour, choice),
};

/** @typedef {typeof packageCurves} Curves */

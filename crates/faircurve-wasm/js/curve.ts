import { Beziers, Conversion, type BezierOptions, type PathContext } from "./beziers.js";
import { checked } from "./error.js";
import type { Join } from "./document.js";
import { joinName } from "./knots.js";
import type { wasm } from "./solver.js";

/** Point, direction and curvature somewhere on a curve. */
export interface CurvePoint {
  x: number;
  y: number;
  /** Direction of travel in radians, not wrapped. */
  direction: number;
  /** In 1/units. */
  curvature: number;
}

/** What holds at a knot of a solved curve. */
export interface SolvedKnot {
  x: number;
  y: number;
  /** The join that the curve has here, after adapting and relaxing. */
  join: Join;
  /** Of arrival, radians in (−π, π]; null where no segment arrives. */
  direction_in: number | null;
  /** Of departure; null where no segment leaves. */
  direction_out: number | null;
  /** Just before the knot, in 1/units. */
  curvature_in: number | null;
  /** Just after the knot. */
  curvature_out: number | null;
}

/** One segment. */
export interface SolvedSegment {
  /** Arc length. */
  length: number;
  /** k₀ … k₃ of thesis eq. 8.1, scaled to arc length 1; for polynomial spirals and lines. */
  kappa?: [number, number, number, number];
}

/** Something that was asked for and could not be met, so that something weaker holds instead. */
export interface Relaxation {
  /** The knot where; or see `segment`. */
  knot?: number;
  /** The segment that leaves the knot of that number. */
  segment?: number;
  /** A join's or a spline's name. */
  asked: string;
  /** A join's or a spline's name. */
  got: string;
  /** Why, in words for a designer. */
  reason: string;
}

/** Something that the chosen spline doesn't have, and what stands in for it. */
export type Adaptation = Omit<Relaxation, "reason">;

/** Measures of a curve's fairness. */
export interface Measures {
  length: number;
  /** ∫κ² ds, in 1/units. */
  bendingEnergy: number;
  /** ∫κ′² ds, in 1/units³; jumps at knots aren't counted. */
  variationEnergy: number;
  /** The largest |κ|. */
  largestCurvature: number;
  /** The largest |κ′|. */
  largestVariation: number;
  /** ∫|κ| ds in radians. */
  turning: number;
  /** Places where |κ| is largest or least within segments. */
  extrema: number;
  /** Places where curvature changes its sign. */
  inflections: number;
  /** length · ∫κ² ds, which has no unit. */
  scaleFreeEnergy: number;
}

/** What jumps at a knot: what leaves less what arrives. */
export interface Jump {
  /** Radians. */
  direction: number;
  curvature: number;
  /** Of dκ/ds. */
  firstDerivative: number;
  /** Of d²κ/ds². */
  secondDerivative: number;
  /** The harmonic mean of the chords: jump · size, · size² and · size³ have no unit. */
  size: number;
}

/** The larger side of what is drawn, times this, is how near Béziers are where nothing is said. */
const DEFAULT_ACCURACY = 1e-4;

/** A solved contour. All its numbers are finite. */
export class Curve {
  /** The spline's name in the catalogue. */
  readonly spline: string;
  /** Whether the last segment returns to the first. */
  readonly closed: boolean;
  readonly #solved: wasm.Solved;

  /** @internal */
  constructor(solved: wasm.Solved, spline: string, closed: boolean) {
    this.#solved = solved;
    this.spline = spline;
    this.closed = closed;
  }

  /** `relaxed` where something could not be met; {@link relaxed} says what and why. */
  get status(): "solved" | "relaxed" {
    return this.#solved.is_solved() ? "solved" : "relaxed";
  }

  /** What could not be met, and why. */
  get relaxed(): Relaxation[] {
    return this.#solved.relaxed() as Relaxation[];
  }

  /** What the spline doesn't have. */
  get adapted(): Adaptation[] {
    return this.#solved.adapted() as Adaptation[];
  }

  /** The largest violated equation, dimensionless; at most 1e-9 where solved. */
  get residual(): number {
    return this.#solved.residual();
  }

  /** Newton steps of the stretch that took most. */
  get iterations(): number {
    return this.#solved.iterations();
  }

  /** How far the search had to go: `plain`, `fused`, `bridged`, `mended` or `grown`. */
  get stage(): string {
    return this.#solved.stage();
  }

  /** Arc length. */
  get length(): number {
    return this.#solved.length();
  }

  /** What holds at each knot. */
  get knots(): SolvedKnot[] {
    const orNull = (x: number) => (Number.isNaN(x) ? null : x);
    return rows(this.#solved.knots(), 7).map(([x, y, join, ...sides]) => {
      const [direction_in, direction_out, curvature_in, curvature_out] = sides.map(orNull);
      return { x, y, join: joinName(join!), direction_in, direction_out, curvature_in, curvature_out } as SolvedKnot;
    });
  }

  /** Each segment's length and parameters. */
  get segments(): SolvedSegment[] {
    return rows(this.#solved.segments(), 5).map(([length, ...kappa]) =>
      Number.isNaN(kappa[0]!) ? { length: length! } : { length: length!, kappa: kappa as [number, number, number, number] },
    );
  }

  /** Point, direction and curvature at an arc length, clamped to the curve; undefined for a lone point. */
  at(s: number): CurvePoint | undefined {
    const [x, y, direction, curvature] = this.#solved.at(Float64Array.of(s));
    return x === undefined ? undefined : ({ x, y, direction, curvature } as CurvePoint);
  }

  /** The same at many arc lengths: rows of x, y, direction, curvature. */
  atMany(places: ArrayLike<number>): Float64Array {
    return this.#solved.at(Float64Array.from(places));
  }

  /**
   * What a curvature comb or a plot of curvature needs: rows of arc length, x, y, direction, curvature; `steps` equal
   * steps in each segment, both its ends included, so that jumps at knots show.
   */
  comb(steps = 16): Float64Array {
    return this.#solved.comb(steps);
  }

  /** Arc lengths at which curvature changes its sign within segments. */
  inflections(): Float64Array {
    return this.#solved.inflections();
  }

  /** Arc lengths at which curvature is largest or least within segments. */
  curvatureExtrema(): Float64Array {
    return this.#solved.curvature_extrema();
  }

  /** Arc lengths at which the curve is horizontal or vertical. */
  axisExtrema(): Float64Array {
    return this.#solved.axis_extrema();
  }

  /** Measures of fairness. */
  measures(): Measures {
    const [
      length, bendingEnergy, variationEnergy, largestCurvature, largestVariation,
      turning, extrema, inflections, scaleFreeEnergy,
    ] = this.#solved.measures();
    return {
      length, bendingEnergy, variationEnergy, largestCurvature, largestVariation,
      turning, extrema, inflections, scaleFreeEnergy,
    } as Measures;
  }

  /** What jumps at each knot; null at the ends of an open curve. */
  jumps(): (Jump | null)[] {
    return rows(this.#solved.jumps(), 5).map(([direction, curvature, firstDerivative, secondDerivative, size]) =>
      Number.isNaN(size!) ? null : ({ direction, curvature, firstDerivative, secondDerivative, size } as Jump),
    );
  }

  /**
   * The nearest point: its segment, the arc length on the segment and the distance, which exceeds the true one by at
   * most `accuracy`; undefined for a lone point.
   */
  nearest(x: number, y: number, accuracy = 1e-6 * this.length): { segment: number; s: number; distance: number } | undefined {
    const [segment, s, distance] = this.#solved.nearest(x, y, accuracy);
    return segment === undefined ? undefined : { segment, s: s!, distance: distance! };
  }

  /** The smallest box that holds the curve. */
  boundingBox(): { x0: number; y0: number; x1: number; y1: number } {
    const [x0, y0, x1, y1] = this.#solved.bounding_box();
    return { x0: x0!, y0: y0!, x1: x1!, y1: y1! };
  }

  /** The curve as the fewest Béziers within an accuracy in the drawing's units; left out: 1/10000 of its larger side. */
  beziers(accuracy = this.#accuracy()): Beziers {
    return new Beziers(this.#solved.path(accuracy));
  }

  /** The curve as Béziers of another kind, with their bound. */
  convert(options: BezierOptions = {}): Conversion {
    const { accuracy = this.#accuracy(), metric = "", fit = "", cuts = "" } = options;
    const { atExtrema = false, atInflections = false, spanKnots = false, freeJoints = false } = options;
    return new Conversion(
      checked(() =>
        this.#solved.convert(accuracy, metric, fit, cuts, atExtrema, atInflections, spanKnots, freeJoints),
      ),
    );
  }

  /** Path data for SVG: `beziers(accuracy).toSVG()`. */
  toSVG(accuracy?: number): string {
    return this.beziers(accuracy).toSVG();
  }

  /** A path for a canvas: `beziers(accuracy).toPath2D()`. */
  toPath2D(accuracy?: number): Path2D {
    return this.beziers(accuracy).toPath2D();
  }

  /** Played onto a context: `beziers(accuracy).draw(context)`. */
  draw(context: PathContext, accuracy?: number): void {
    this.beziers(accuracy).draw(context);
  }

  /** Gives its memory back now, not when the collector comes by. It can't be used any more. */
  free(): void {
    this.#solved.free();
  }

  #accuracy(): number {
    const { x0, y0, x1, y1 } = this.boundingBox();
    return DEFAULT_ACCURACY * Math.max(x1 - x0, y1 - y0);
  }
}

function rows(numbers: Float64Array, width: number): number[][] {
  return Array.from({ length: numbers.length / width }, (_, i) => [...numbers.subarray(width * i, width * (i + 1))]);
}

/**
 * Fair curves for d3-shape: `line().curve(curveFair)`.
 *
 * ```js
 * import { line } from "d3-shape";
 * import { curveFair } from "faircurve/d3";
 * const path = line().curve(curveFair.spline("hobby").tension(1.1))(data);
 * ```
 *
 * **These are shapes, not functions of x.** A fair curve through data may swing out beyond a knot, and even turn back, so
 * that it has two values over one x. Use it for outlines, routes and links; for values over time, where the eye
 * reads off y, `d3.curveMonotoneX` doesn't lie.
 *
 * Points that aren't finite are left out, so that no path has a NaN; for gaps use `line().defined(…)`, as with
 * every curve of d3.
 * @module
 */
import type { PathContext } from "./beziers.js";
import { solveContour } from "./index.js";
import type { Join, Knot, Params } from "./document.js";

/** What d3 calls to draw. */
export interface CurveGenerator {
  areaStart(): void;
  areaEnd(): void;
  lineStart(): void;
  lineEnd(): void;
  point(x: number, y: number): void;
}

/** A curve factory of d3 whose methods give the same factory with one more choice made. */
export interface FairCurve {
  (context: PathContext): CurveGenerator;
  /** Which spline of the catalogue; `spiro` at first. Forgets the parameters. */
  spline(name: string): FairCurve;
  /** Any parameter of the spline. */
  param(name: string, value: number | string): FairCurve;
  /** Of `hobby`. */
  tension(tension: number): FairCurve;
  /** Of `hobby`, at free ends. */
  curl(curl: number): FairCurve;
  /** The exponent of `log-aesthetic`. */
  alpha(alpha: number): FairCurve;
  /** What holds at free ends, such as `zero-curvature`. */
  end(end: string): FairCurve;
  /** The join of every knot; the spline's own if not set. */
  join(join: Join): FairCurve;
  /** The largest distance of the Béziers from the curve, in the units of the path; 0.1 at first. */
  accuracy(accuracy: number): FairCurve;
}

interface Choices {
  spline: string;
  params: Params;
  join?: Join;
  accuracy: number;
}

abstract class Fair implements CurveGenerator {
  protected points: Knot[] = [];
  protected line = NaN;

  constructor(
    protected readonly context: PathContext,
    protected readonly choices: Choices,
  ) {}

  abstract areaStart(): void;
  abstract areaEnd(): void;
  abstract lineEnd(): void;

  lineStart(): void {
    this.points = [];
  }

  point(x: number, y: number): void {
    // As every curve of d3 does: what comes may be a string.
    const [px, py] = [+x, +y];
    if (Number.isFinite(px) && Number.isFinite(py)) this.points.push({ x: px, y: py, join: this.choices.join });
  }

  /** Goes to the first point, and along the curve to the last. */
  protected draw(closed: boolean): void {
    const { context, points, choices } = this;
    const [first] = points;
    if (first === undefined) return;
    if (this.line) context.lineTo(first.x, first.y);
    else context.moveTo(first.x, first.y);
    if (points.length === 2) context.lineTo(points[1]!.x, points[1]!.y);
    if (points.length > 2) {
      const { spline, params, accuracy } = choices;
      const curve = solveContour({ spline, params, closed, knots: points });
      curve.beziers(accuracy).draw(context, 1);
      curve.free();
    }
  }
}

class Open extends Fair {
  areaStart(): void {
    this.line = 0;
  }

  areaEnd(): void {
    this.line = NaN;
  }

  lineEnd(): void {
    this.draw(false);
    // The second line of an area closes it; a lone point is a dot.
    if (this.line || (this.line !== 0 && this.points.length === 1)) this.context.closePath();
    this.line = 1 - this.line;
  }
}

class Closed extends Fair {
  areaStart(): void {}

  areaEnd(): void {}

  lineEnd(): void {
    this.line = 0;
    this.draw(true);
    if (this.points.length === 1 || this.points.length === 2) this.context.closePath();
  }
}

function factory(Generator: typeof Open | typeof Closed, choices: Choices): FairCurve {
  const make = (context: PathContext) => new Generator(context, choices);
  const also = (changes: Partial<Choices>) => factory(Generator, { ...choices, ...changes });
  const param = (name: string, value: number | string) => also({ params: { ...choices.params, [name]: value } });
  return Object.assign(make, {
    spline: (spline: string) => also({ spline, params: {} }),
    param,
    tension: (tension: number) => param("tension", tension),
    curl: (curl: number) => param("curl", curl),
    alpha: (alpha: number) => param("alpha", alpha),
    end: (end: string) => param("end", end),
    join: (join: Join) => also({ join }),
    accuracy: (accuracy: number) => also({ accuracy }),
  });
}

const defaults: Choices = { spline: "spiro", params: {}, accuracy: 0.1 };

/** The fair curve through the points, from the first to the last. See the warning above: it is no function of x. */
export const curveFair: FairCurve = factory(Open, defaults);

/** The closed fair curve through the points. */
export const curveFairClosed: FairCurve = factory(Closed, defaults);

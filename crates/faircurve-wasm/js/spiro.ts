/**
 * The calls of the npm package `spiro`, so that its users change one import:
 *
 * ```js
 * import { spiroToBezierOnContext } from "faircurve/spiro"; // was: from "spiro"
 * ```
 *
 * What differs: every input has a finite curve, or a `FaircurveError` that says what is wrong with it; a knot that
 * can't be met is relaxed; there are as few Béziers as the accuracy allows. Arcs (`spiroToArcs`) aren't here: `Curve`
 * of the package itself answers what they did.
 * @module
 */
import type { Join, Knot as OwnKnot } from "./document.js";
import { solve } from "./index.js";

export type Point = { x: number; y: number };

/**
 * How a knot joins: `left` is where a curve comes in and a straight line leaves, `right` the other way round; `open` and
 * `open_end` are the ends of an open contour.
 */
export type PointType = "corner" | "open" | "open_end" | "left" | "right" | "g2" | "g4";

/** Called when a knot is reached, with the knot before it and itself; for the first knot with itself alone. */
export type KnotCallback<C> = (this: C, x0: number, y0: number, x1?: number, y1?: number) => void;

export type Knot<C> = Point & { type: PointType; af?: KnotCallback<C> };

/** What a curve is played onto. */
export interface IBezierContext {
  beginShape(): void;
  endShape(): void;
  moveTo(x: number, y: number): void;
  lineTo(x: number, y: number): void;
  cubicTo(x1: number, y1: number, x2: number, y2: number, x: number, y: number): void;
}

export type LineArc = { order: 1; start: Point; end: Point };
export type QuadArc = { order: 2; start: Point; c1: Point; end: Point };
export type CubeArc = { order: 3; start: Point; c1: Point; c2: Point; end: Point };
export type Arc = LineArc | QuadArc | CubeArc;

/** Collects lines and Béziers. */
export class DefaultBezierContext implements IBezierContext {
  strands: Arc[] = [];
  lastx = 0;
  lasty = 0;

  beginShape(): void {}

  endShape(): void {}

  moveTo(x: number, y: number): void {
    this.lastx = x;
    this.lasty = y;
  }

  lineTo(x: number, y: number): void {
    this.strands.push({ order: 1, start: this.#here(), end: { x, y } });
    this.moveTo(x, y);
  }

  curveTo(x1: number, y1: number, x: number, y: number): void {
    this.strands.push({ order: 2, start: this.#here(), c1: { x: x1, y: y1 }, end: { x, y } });
    this.moveTo(x, y);
  }

  cubicTo(x1: number, y1: number, x2: number, y2: number, x: number, y: number): void {
    this.strands.push({ order: 3, start: this.#here(), c1: { x: x1, y: y1 }, c2: { x: x2, y: y2 }, end: { x, y } });
    this.moveTo(x, y);
  }

  #here(): Point {
    return { x: this.lastx, y: this.lasty };
  }
}

const JOINS: Record<PointType, Join> = {
  corner: "corner",
  open: "corner",
  open_end: "corner",
  left: "curve-to-terminal",
  right: "terminal-to-curve",
  g2: "g2",
  g4: "g4",
};

/**
 * Plays the curve through the knots onto a context, as lines and cubic Béziers.
 * @param delta the largest distance of the Béziers from the curve, in the drawing's units; left out: 1/10000 of the larger side
 */
export function spiroToBezierOnContext<C extends IBezierContext>(
  spiros: Knot<C>[],
  isClosed: boolean,
  bc: C,
  delta?: number,
): void {
  bc.beginShape();
  const [first] = spiros;
  if (first !== undefined) {
    // A type that isn't known goes on as it is, so that the error names it.
    const knots = spiros.map(({ x, y, type }): OwnKnot => ({ x, y, join: JOINS[type] ?? (type as Join) }));
    const curve = solve({ contours: [{ closed: isClosed, knots }] }).contours[0]!;
    const { data } = curve.beziers(delta);
    curve.free();
    bc.moveTo(first.x, first.y);
    first.af?.call(bc, first.x, first.y);
    playSegments(bc, data, isClosed ? [...spiros, first] : spiros);
  }
  bc.endShape();
}

/** Every segment's Béziers, and the callback of the knot at its end. Knots are ends of Béziers to the bit. */
function playSegments<C extends IBezierContext>(bc: C, data: Float64Array, knots: Knot<C>[]): void {
  let i = 3;
  for (let k = 1; k < knots.length; k++) {
    const [before, knot] = [knots[k - 1]!, knots[k]!];
    let [x, y] = [before.x, before.y];
    while (i < data.length && data[i]! < 4 && (x !== knot.x || y !== knot.y)) {
      if (data[i] === 1) {
        [x, y] = [data[i + 1]!, data[i + 2]!];
        bc.lineTo(x, y);
        i += 3;
      } else {
        [x, y] = [data[i + 5]!, data[i + 6]!];
        bc.cubicTo(data[i + 1]!, data[i + 2]!, data[i + 3]!, data[i + 4]!, x, y);
        i += 7;
      }
    }
    knot.af?.call(bc, before.x, before.y, knot.x, knot.y);
  }
}

/** The curve through the knots as lines and cubic Béziers. */
export function spiroToBezier(spiros: Knot<IBezierContext>[], isClosed: boolean): Arc[] {
  const context = new DefaultBezierContext();
  spiroToBezierOnContext(spiros, isClosed, context);
  return context.strands;
}

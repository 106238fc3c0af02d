/**
 * The calls of the npm package `spiro`, so that its users change one import:
 *
 * ```js
 * import { spiroToBezierOnContext } from "faircurve/spiro"; // was: from "spiro"
 * ```
 *
 * What differs: every input has a finite curve, or a `FaircurveError` that says what is wrong with it; a knot that
 * can't be met is relaxed; there are as few Béziers as the accuracy allows.
 * @module
 */
import type { Join, Knot as OwnKnot } from "./document.js";
import { type Curve, solveContour } from "./index.js";
import { SpiroArc, type SpiroK } from "./spiro-arc.js";

export { SpiroArc, type SpiroK };

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

/** What a curve is played onto, arc by arc. */
export interface IArcContext {
  beginShape(): void;
  endShape(): void;
  moveTo(x: number, y: number): void;
  arcTo(arc: SpiroArc, x: number, y: number, isStraight: boolean): void;
}

/** Collects arcs. */
export class SimplyCollectArcContext implements IArcContext {
  arcs: SpiroArc[] = [];

  beginShape(): void {}

  endShape(): void {}

  moveTo(): void {}

  arcTo(arc: SpiroArc): void {
    this.arcs.push(arc);
  }
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
    const curve = solved(spiros, isClosed);
    const { data } = curve.beziers(delta);
    curve.free();
    bc.moveTo(first.x, first.y);
    first.af?.call(bc, first.x, first.y);
    playSegments(bc, data, isClosed ? [...spiros, first] : spiros);
  }
  bc.endShape();
}

function solved(spiros: Knot<never>[], closed: boolean): Curve {
  // A type that isn't known goes on as it is, so that the error names it.
  const knots = spiros.map(({ x, y, type }): OwnKnot => ({ x, y, join: JOINS[type] ?? (type as Join) }));
  return solveContour({ closed, knots });
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

/** Plays the curve through the knots onto a context, as one arc from each knot to the next. */
export function spiroToArcsOnContext<C extends IArcContext>(spiros: Knot<C>[], isClosed: boolean, context: C): void {
  context.beginShape();
  const [first] = spiros;
  if (first !== undefined) {
    const curve = solved(spiros, isClosed);
    const { segments } = curve;
    curve.free();
    context.moveTo(first.x, first.y);
    first.af?.call(context, first.x, first.y);
    const knots = isClosed ? [...spiros, first] : spiros;
    segments.forEach(({ kappa }, i) => {
      const [{ x: x0, y: y0 }, { x, y, af }] = [knots[i]!, knots[i + 1]!];
      const arc = new SpiroArc(kappa ?? [0, 0, 0, 0], x0, y0, x, y);
      context.arcTo(arc, x, y, arc.isStraight);
      af?.call(context, x0, y0, x, y);
    });
  }
  context.endShape();
}

/** The curve through the knots as arcs, one from each knot to the next. */
export function spiroToArcs(spiros: Knot<IArcContext>[], isClosed: boolean): SpiroArc[] {
  const context = new SimplyCollectArcContext();
  spiroToArcsOnContext(spiros, isClosed, context);
  return context.arcs;
}

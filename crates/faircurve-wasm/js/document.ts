// The document: what a designer gives. The same keys as in files (`faircurve` JSON).

/** How the two segments at a knot meet. */
export type Join =
  /** Nothing is continuous: each side ends on its own. */
  | "corner"
  /** The direction is continuous: the one given, or that of the circle through the knot and its neighbours. */
  | "g1"
  /** Direction and curvature are continuous. */
  | "g2"
  /** So are the first two derivatives of curvature. */
  | "g4"
  /** A curve comes in and adapts to what leaves, typically a straight line. */
  | "curve-to-terminal"
  /** The same the other way round. */
  | "terminal-to-curve";

/** A vector. */
export type Vector = readonly [x: number, y: number];

/** A point that the curve passes through, with how it joins there and what else is given. */
export interface Knot {
  /** In the drawing's units. */
  x: number;
  /** In the drawing's units; y points up, unless all of your drawing points down. */
  y: number;
  /** Left out: the spline's own default. Ignored at the ends of an open contour. */
  join?: Join | undefined;
  /** Direction of the curve on both sides, any length but zero. */
  tangent?: Vector | undefined;
  /** Direction in which it arrives. */
  tangent_in?: Vector | undefined;
  /** Direction in which it leaves. */
  tangent_out?: Vector | undefined;
  /** Curvature just before, in 1/units; positive turns from +x towards +y. */
  curvature_in?: number | undefined;
  /** Curvature just after. */
  curvature_out?: number | undefined;
  /** Tension just before, for splines that have it. */
  tension_in?: number | undefined;
  /** Tension just after. */
  tension_out?: number | undefined;
  /** Curl at an end, for splines that have it. */
  curl?: number | undefined;
}

/** Parameters of a spline by name; see {@link catalogue}. */
export type Params = Readonly<Record<string, number | string>>;

/** A spline of the catalogue with its parameters. */
export interface SplineChoice {
  /** Its name; left out: `spiro`. */
  spline?: string | undefined;
  /** Its parameters; those left out have their defaults. */
  params?: Params | undefined;
}

/** Knots in order. A closed contour of n knots has n segments, an open one n − 1. */
export interface Contour extends SplineChoice {
  /** Whether the curve returns from the last knot to the first; left out: no. */
  closed?: boolean | undefined;
  /** The knots in the order of travel; at least one. */
  knots: readonly Knot[];
}

/** The contours of one layer of one glyph. */
export interface Glyph {
  /** Empty or left out for an unnamed one. */
  name?: string | undefined;
  /** Empty or left out where there are no layers. */
  layer?: string | undefined;
  contours: readonly Contour[];
}

/**
 * A drawing: `contours` of one unnamed glyph, or `glyphs`. The spline and parameters are those of every contour
 * that has none of its own. What `JSON.parse` makes of a `faircurve` document is one.
 */
export interface Document extends SplineChoice {
  /** The version of the format. */
  faircurve?: 1 | undefined;
  glyphs?: readonly Glyph[] | undefined;
  contours?: readonly Contour[] | undefined;
}

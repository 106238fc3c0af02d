// What a point in the hand snaps to: a table of sources, each of which names coordinates.

/** @typedef {import("./geometry.js").Point} Point */
/** @typedef {{axis: "x" | "y", value: number, from?: Point}} Line a coordinate, and the point that it is from */
/**
 * @typedef {object} Surroundings
 * @property {readonly Point[]} knots that don't move
 * @property {readonly Point[]} extrema of curves that don't move
 * @property {number} grid in units
 */
/** @typedef {{id: string, label: string, lines: (point: Point, around: Surroundings) => Line[]}} Source */

/** @param {readonly Point[]} points @returns {Line[]} */
const linesThrough = (points) =>
  points.flatMap((from) => [{ axis: /** @type {const} */ ("x"), value: from.x, from }, { axis: /** @type {const} */ ("y"), value: from.y, from }]);

/** In order of rank: where two lines are as near, the earlier is taken. @type {readonly Source[]} */
export const SOURCES = [
  { id: "knots", label: "Knots", lines: (_, { knots }) => linesThrough(knots) },
  { id: "extrema", label: "Extrema", lines: (_, { extrema }) => linesThrough(extrema) },
  { id: "axes", label: "Axes", lines: () => [{ axis: "x", value: 0 }, { axis: "y", value: 0 }] },
];

/**
 * A point after snapping, and the lines that it snapped to, to be shown. The grid has the last word on
 * coordinates that nothing else has taken.
 * @param {Point} point
 * @param {Surroundings} around
 * @param {{[id: string]: boolean | undefined}} on which sources, and `grid`
 * @param {number} reach in units
 * @returns {{point: Point, lines: Line[]}}
 */
export function snapped(point, around, on, reach) {
  const lines = SOURCES.filter(({ id }) => on[id]).flatMap((source) => source.lines(point, around));
  const result = { ...point };
  /** @type {Line[]} */
  const taken = [];
  for (const axis of /** @type {const} */ (["x", "y"])) {
    let best = null;
    for (const line of lines) {
      const off = Math.abs(line.value - point[axis]);
      if (line.axis === axis && off <= reach && off < (best?.off ?? Infinity)) best = { line, off };
    }
    if (best) {
      result[axis] = best.line.value;
      taken.push(best.line);
    } else if (on.grid && around.grid > 0) {
      result[axis] = Math.round(point[axis] / around.grid) * around.grid + 0;
    }
  }
  return { point: result, lines: taken };
}

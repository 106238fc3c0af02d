// Points, affine maps and boxes of the plane, y up.

/** @typedef {{x: number, y: number}} Point */
/**
 * An affine map: (x, y) → (a·x + c·y + e, b·x + d·y + f).
 * @typedef {readonly [a: number, b: number, c: number, d: number, e: number, f: number]} Affine
 */
/** @typedef {{x0: number, y0: number, x1: number, y1: number}} Box */

/** @param {Point} p @param {Point} q */
export const distance = (p, q) => Math.hypot(p.x - q.x, p.y - q.y);

/** @param {Affine} m @param {Point} p @returns {Point} */
export const apply = ([a, b, c, d, e, f], { x, y }) => ({ x: a * x + c * y + e, y: b * x + d * y + f });

/** A direction under the linear part. @param {Affine} m @param {readonly [number, number]} v @returns {[number, number]} */
export const applyToVector = ([a, b, c, d], [x, y]) => [a * x + c * y, b * x + d * y];

/** @param {Affine} m Whether it mirrors. */
export const mirrors = ([a, b, c, d]) => a * d - b * c < 0;

/** @param {number} dx @param {number} dy @returns {Affine} */
export const translation = (dx, dy) => [1, 0, 0, 1, dx, dy];

/**
 * The linear map a, b, c, d with `centre` where it is.
 * @param {Point} centre
 * @param {readonly [number, number, number, number]} linear
 * @returns {Affine}
 */
const about = ({ x, y }, [a, b, c, d]) => [a, b, c, d, x - a * x - c * y, y - b * x - d * y];

/** @param {Point} centre @param {number} angle In radians, counterclockwise. @returns {Affine} */
export function rotation(centre, angle) {
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  return about(centre, [cos, sin, -sin, cos]);
}

/** @param {Point} centre @param {number} sx @param {number} sy @returns {Affine} */
export const scaling = (centre, sx, sy) => about(centre, [sx, 0, 0, sy]);

/** The least box around points; `null` around none. @param {Iterable<Point>} points @returns {Box | null} */
export function boxOf(points) {
  let box = null;
  for (const { x, y } of points) {
    box ??= { x0: x, y0: y, x1: x, y1: y };
    box.x0 = Math.min(box.x0, x);
    box.y0 = Math.min(box.y0, y);
    box.x1 = Math.max(box.x1, x);
    box.y1 = Math.max(box.y1, y);
  }
  return box;
}

/** @param {Box | null} a @param {Box | null} b @returns {Box | null} */
export function union(a, b) {
  if (!a || !b) return a ?? b;
  return { x0: Math.min(a.x0, b.x0), y0: Math.min(a.y0, b.y0), x1: Math.max(a.x1, b.x1), y1: Math.max(a.y1, b.y1) };
}

/** @param {Box} box @returns {Point} */
export const centreOf = (box) => ({ x: (box.x0 + box.x1) / 2, y: (box.y0 + box.y1) / 2 });

/** @param {Box} box @param {Point} p */
export const contains = (box, { x, y }) => x >= box.x0 && x <= box.x1 && y >= box.y0 && y <= box.y1;

/** Rounded to the decimals that a designer reads. @param {number} x @param {number} [decimals] */
export function rounded(x, decimals = 3) {
  const unit = 10 ** decimals;
  return Math.round(x * unit) / unit + 0;
}

// The curvature comb as paths in drawing units.

/** @typedef {import("../curves/curves.js").Solved} Solved */

/**
 * Teeth on the convex side, and the rim through their tips; the rim breaks where the curve has a corner.
 * @param {Solved} curve
 * @param {number} amplitude units of length for a curvature of 1
 * @param {number} limit the longest tooth
 */
export function combPath(curve, amplitude, limit) {
  const [teeth, rim] = [new Path2D(), new Path2D()];
  for (const rows of curve.comb) {
    for (let i = 0; i < rows.length; i += 5) {
      const [x, y, direction, curvature] = [rows[i + 1], rows[i + 2], rows[i + 3], rows[i + 4]];
      const length = Math.max(-limit, Math.min(limit, curvature * amplitude));
      const [tipX, tipY] = [x + Math.sin(direction) * length, y - Math.cos(direction) * length];
      teeth.moveTo(x, y);
      teeth.lineTo(tipX, tipY);
      if (i === 0) rim.moveTo(tipX, tipY);
      else rim.lineTo(tipX, tipY);
    }
  }
  return { teeth, rim };
}

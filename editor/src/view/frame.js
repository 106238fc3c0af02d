// The frame around several selected knots, by whose handles they are scaled and turned.

import { centreOf, rotation, scaling } from "../core/geometry.js";

/** @typedef {import("../core/geometry.js").Point} Point */
/** @typedef {import("../core/geometry.js").Box} Box */
/** @typedef {import("../core/geometry.js").Affine} Affine */
/** @typedef {{kind: "scale" | "rotate", sx: number, sy: number, x: number, y: number, cursor: string}} Handle on the screen */

/** Pixels between the knots and the frame. */
const GAP = 12;

/** @param {import("./viewport.js").Viewport} viewport @param {Box} box @returns {Handle[]} */
export function frameHandles(viewport, box) {
  const [low, high] = [viewport.toScreen({ x: box.x0, y: box.y0 }), viewport.toScreen({ x: box.x1, y: box.y1 })];
  const xs = [low.x - GAP, (low.x + high.x) / 2, high.x + GAP];
  const ys = [low.y + GAP, (low.y + high.y) / 2, high.y - GAP];
  const handle = (/** @type {number} */ sx, /** @type {number} */ sy) => {
    const cursor = sx === 0 ? "ns-resize" : sy === 0 ? "ew-resize" : sx === sy ? "nesw-resize" : "nwse-resize";
    return { kind: /** @type {const} */ ("scale"), sx, sy, x: xs[sx + 1], y: ys[sy + 1], cursor };
  };
  const wide = box.x1 > box.x0;
  const tall = box.y1 > box.y0;
  const scales = [
    ...(wide && tall ? [handle(-1, -1), handle(1, -1), handle(1, 1), handle(-1, 1)] : []),
    ...(wide ? [handle(-1, 0), handle(1, 0)] : []),
    ...(tall ? [handle(0, -1), handle(0, 1)] : []),
  ];
  return [...scales, { kind: "rotate", sx: 0, sy: 0, x: xs[1], y: ys[2] - 24, cursor: "grab" }];
}

/**
 * The map of a drag.
 * @param {Handle} handle
 * @param {Box} box as it was
 * @param {Point} from in the drawing
 * @param {Point} to
 * @param {{even: boolean, fromCentre: boolean}} how
 * @returns {Affine}
 */
export function frameMap(handle, box, from, to, { even, fromCentre }) {
  const centre = centreOf(box);
  if (handle.kind === "rotate") {
    const turn = Math.atan2(to.y - centre.y, to.x - centre.x) - Math.atan2(from.y - centre.y, from.x - centre.x);
    const step = Math.PI / 12;
    return rotation(centre, even ? Math.round(turn / step) * step : turn);
  }
  const fixed = fromCentre ? centre : {
    x: handle.sx > 0 ? box.x0 : handle.sx < 0 ? box.x1 : centre.x,
    y: handle.sy > 0 ? box.y0 : handle.sy < 0 ? box.y1 : centre.y,
  };
  const factor = (/** @type {"x" | "y"} */ axis, /** @type {number} */ sign) => {
    const edge = axis === "x" ? (sign > 0 ? box.x1 : box.x0) : sign > 0 ? box.y1 : box.y0;
    return sign === 0 ? 1 : (edge - fixed[axis] + to[axis] - from[axis]) / (edge - fixed[axis]);
  };
  let [sx, sy] = [factor("x", handle.sx), factor("y", handle.sy)];
  if (even && handle.sx !== 0 && handle.sy !== 0) {
    const larger = Math.max(Math.abs(sx), Math.abs(sy));
    [sx, sy] = [Math.sign(sx) * larger, Math.sign(sy) * larger];
  }
  return scaling(fixed, sx, sy);
}

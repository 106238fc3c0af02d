// Where the drawing is on the screen. Screen points are CSS pixels of the canvas, y down.

/** @typedef {import("../core/geometry.js").Point} Point */
/** @typedef {import("../core/geometry.js").Box} Box */

export const ZOOM_LIMITS = { min: 0.005, max: 400 };

export class Viewport {
  /** Pixels a unit. */
  scale = 1;
  /** Where the drawing's origin is. */
  originX = 0;
  originY = 0;
  width = 1;
  height = 1;

  /** @param {Point} p @returns {Point} */
  toScreen({ x, y }) {
    return { x: this.originX + x * this.scale, y: this.originY - y * this.scale };
  }

  /** @param {Point} p @returns {Point} */
  toDrawing({ x, y }) {
    return { x: (x - this.originX) / this.scale, y: (this.originY - y) / this.scale };
  }

  /** The canvas's transform for drawing units. @param {number} ratio device pixels a CSS pixel @returns {[number, number, number, number, number, number]} */
  matrix(ratio) {
    const s = this.scale * ratio;
    return [s, 0, 0, -s, this.originX * ratio, this.originY * ratio];
  }

  /** @returns {Box} what is seen, in drawing units */
  get box() {
    const low = this.toDrawing({ x: 0, y: this.height });
    const high = this.toDrawing({ x: this.width, y: 0 });
    return { x0: low.x, y0: low.y, x1: high.x, y1: high.y };
  }

  /** @param {number} dx @param {number} dy in pixels */
  pan(dx, dy) {
    this.originX += dx;
    this.originY += dy;
  }

  /** @param {number} factor @param {Point} at the screen point that stays */
  zoom(factor, at = { x: this.width / 2, y: this.height / 2 }) {
    const scale = Math.min(ZOOM_LIMITS.max, Math.max(ZOOM_LIMITS.min, this.scale * factor));
    const fixed = this.toDrawing(at);
    this.scale = scale;
    this.originX = at.x - fixed.x * scale;
    this.originY = at.y + fixed.y * scale;
  }

  /** @param {Box} box shown whole @param {number} [margin] a part of the view on each side */
  fit(box, margin = 0.12) {
    const [width, height] = [box.x1 - box.x0, box.y1 - box.y0];
    const room = 1 - 2 * margin;
    const scale = Math.min((this.width * room) / Math.max(width, 1e-9), (this.height * room) / Math.max(height, 1e-9));
    this.scale = Math.min(ZOOM_LIMITS.max, Math.max(ZOOM_LIMITS.min, scale));
    this.originX = this.width / 2 - ((box.x0 + box.x1) / 2) * this.scale;
    this.originY = this.height / 2 + ((box.y0 + box.y1) / 2) * this.scale;
  }
}

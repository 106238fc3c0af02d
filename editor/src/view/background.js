// A picture to trace over. It isn't part of the document.

export class Background {
  /** @type {ImageBitmap | null} */
  image = null;
  /** Of its lower left corner, in drawing units. */
  x = 0;
  y = 0;
  /** Units a pixel of the picture. */
  scale = 1;
  opacity = 0.35;
  locked = true;

  /** @param {import("./scene.js").Scene} scene */
  draw({ context, viewport }) {
    if (!this.image) return;
    const at = viewport.toScreen({ x: this.x, y: this.y + this.image.height * this.scale });
    const size = this.scale * viewport.scale;
    context.globalAlpha = this.opacity;
    context.drawImage(this.image, at.x, at.y, this.image.width * size, this.image.height * size);
    context.globalAlpha = 1;
  }

  /** Whether it can be grasped at a point. @param {import("../core/geometry.js").Point} p */
  holds({ x, y }) {
    if (!this.image || this.locked) return false;
    return x >= this.x && y >= this.y && x <= this.x + this.image.width * this.scale && y <= this.y + this.height;
  }

  /** Height of the picture in units, which is how its size is told. */
  get height() {
    return (this.image?.height ?? 0) * this.scale;
  }

  /** @param {number} height in units */
  set height(height) {
    if (this.image && height > 0) this.scale = height / this.image.height;
  }
}

// The symbols of joins, as docs/knot-symbols.md has them: on the canvas and in buttons.

/** @typedef {import("../core/joins.js").Symbol} Symbol */

const R = 4;

/** What each symbol is around (0, 0), travel along +x, y down, and whether it is filled. @type {Record<Symbol | "triangle" | "bar", {outline: string, filled: boolean, turns: boolean}>} */
export const SYMBOLS = {
  "square": { outline: `M${-R},${-R}H${R}V${R}H${-R}Z`, filled: true, turns: false },
  "diamond": { outline: "M0,-5.5L5.5,0L0,5.5L-5.5,0Z", filled: true, turns: false },
  "ring": { outline: disc(4), filled: false, turns: false },
  "disc": { outline: disc(4.5), filled: true, turns: false },
  "half-disc-in": { outline: "M1.5,-5A5,5 0 0 0 1.5,5Z", filled: true, turns: true },
  "half-disc-out": { outline: "M-1.5,-5A5,5 0 0 1 -1.5,5Z", filled: true, turns: true },
  "triangle": { outline: "M-4,-5L6,0L-4,5Z", filled: true, turns: true },
  "bar": { outline: "M-1.5,-6H1.5V6H-1.5Z", filled: true, turns: true },
};

/** @param {number} r */
function disc(r) {
  return `M${r},0A${r},${r} 0 1 1 ${-r},0A${r},${r} 0 1 1 ${r},0Z`;
}

/** @type {Map<string, Path2D>} */
const paths = new Map();

/** @param {keyof typeof SYMBOLS} name */
function pathOf(name) {
  let path = paths.get(name);
  if (!path) paths.set(name, (path = new Path2D(SYMBOLS[name].outline)));
  return path;
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {keyof typeof SYMBOLS} name
 * @param {{x: number, y: number, direction: number, size: number, ink: string, paper: string}} how direction in the drawing, y up
 */
export function drawSymbol(context, name, { x, y, direction, size, ink, paper }) {
  const { filled, turns } = SYMBOLS[name];
  context.save();
  context.translate(x, y);
  if (turns) context.rotate(-direction);
  context.scale(size, size);
  const path = pathOf(name);
  // A rim of paper sets the symbol off the curve.
  context.lineJoin = "round";
  context.strokeStyle = paper;
  context.lineWidth = filled ? 3 : 4.5;
  context.stroke(path);
  context.fillStyle = filled ? ink : paper;
  context.fill(path);
  if (!filled) {
    context.strokeStyle = ink;
    context.lineWidth = 1.8;
    context.stroke(path);
  }
  context.restore();
}

/** The symbol as an SVG picture for a button. @param {keyof typeof SYMBOLS} name */
export function symbolPicture(name) {
  const { outline, filled } = SYMBOLS[name];
  const paint = filled ? 'fill="currentColor"' : 'fill="none" stroke="currentColor" stroke-width="1.8"';
  return `<svg viewBox="-8 -8 16 16" width="16" height="16" aria-hidden="true"><path d="${outline}" ${paint}/></svg>`;
}

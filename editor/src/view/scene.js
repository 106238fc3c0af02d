// What one frame shows, gathered once for all layers.

/** @typedef {import("../core/geometry.js").Point} Point */
/** @typedef {import("../curves/curves.js").Solved} Solved */
/** @typedef {import("../core/selection.js").Place} Place */
/**
 * @typedef {object} Scene
 * @property {CanvasRenderingContext2D} context in CSS pixels, y down
 * @property {number} ratio device pixels a CSS pixel
 * @property {import("./viewport.js").Viewport} viewport
 * @property {import("../core/commands.js").State} state
 * @property {readonly import("../core/document.js").Contour[]} contours
 * @property {readonly Solved[]} curves one for each contour
 * @property {import("../core/settings.js").Values} settings
 * @property {Record<string, string>} colours
 * @property {Overlay} overlay
 * @property {readonly Compared[]} compared
 * @property {import("./background.js").Background} background
 * @property {boolean} isInHand whether something is dragged or previewed
 * @property {number} combReference the curvature whose tooth has the set length
 */
/** Curves of one spline beside the drawing's own. @typedef {{name: string, colour: string, curves: readonly Solved[]}} Compared */
/**
 * What the tool shows over the drawing.
 * @typedef {object} Overlay
 * @property {Place | null} [hover]
 * @property {import("../core/geometry.js").Box | null} [marquee]
 * @property {readonly import("../core/snap.js").Line[]} [lines] snapped to
 * @property {Point | null} [at] the point that is snapped
 * @property {import("../core/geometry.js").Box | null} [frame] around what is transformed
 * @property {Place | null} [ghost] a knot that isn't there yet
 * @property {{x: number, y: number, closes?: boolean} | null} [mark] where a click would act
 */

/** Draws in drawing units, y up. @param {Scene} scene @param {(unit: number) => void} draw gets the units of a pixel */
export function inDrawing({ context, viewport, ratio }, draw) {
  context.save();
  context.setTransform(...viewport.matrix(ratio));
  draw(1 / viewport.scale);
  context.restore();
}

/** The accuracy of what is seen: a twentieth of a pixel, the same for zooms that are near to each other. @param {import("./viewport.js").Viewport} viewport */
export const seenAccuracy = (viewport) => 2 ** Math.floor(Math.log2(0.1 / viewport.scale));

/** @param {Scene} scene @param {Place} place */
export const isSelected = (scene, { contour, knot }) => scene.state.selection.has(contour, knot);

/** The join that holds at a knot, the spline's own where none is given. @param {Scene} scene @param {Place} place */
export const joinAt = (scene, { contour, knot }) => scene.curves[contour]?.knots[knot]?.join ?? "g4";

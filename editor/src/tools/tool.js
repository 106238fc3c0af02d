// What a tool is: a record. The canvas gives it pointers and keys; it gives the editor commands.

/** @typedef {import("../core/geometry.js").Point} Point */
/**
 * @typedef {object} Pointer
 * @property {Point} screen in pixels of the canvas
 * @property {Point} point in the drawing
 * @property {"mouse" | "pen" | "touch"} kind
 * @property {boolean} shift
 * @property {boolean} alt
 * @property {boolean} ctrl ⌘ on Apple's keyboards
 * @property {number} clicks 2 for a double click
 */
/**
 * @typedef {object} Studio what tools work on
 * @property {import("../core/editor.js").Editor} editor
 * @property {import("../view/stage.js").Stage} stage
 * @property {import("../core/settings.js").Settings} settings
 * @property {(name: string) => import("faircurve").SplineInfo} info of a spline of the catalogue
 * @property {(message: string) => void} say to the status line
 * @property {(id: string) => void} useTool
 * @property {{keepPicture: () => void}} keeping
 */
/** A press until its end: what happens as the pointer moves. @typedef {{move?: (at: Pointer) => void, end?: (at: Pointer) => void, cancel?: () => void}} Drag */
/**
 * @typedef {object} Tool
 * @property {string} id
 * @property {string} label
 * @property {string} key
 * @property {string} icon path data in a box of 24
 * @property {string} hint
 * @property {boolean} [frame] whether selected knots have a frame
 * @property {(studio: Studio, at: Pointer) => string} hover returns the cursor
 * @property {(studio: Studio, at: Pointer) => Drag | null} press
 * @property {(studio: Studio) => void} [leave] the pointer is gone
 */

/** Coordinates as a designer wants them: on the grid where that is on, else to a thousandth. */
export { snapped } from "../core/snap.js";

/**
 * What a moving point may snap to: every knot and extremum that stays.
 * @param {Studio} studio
 * @param {(contour: number, knot: number) => boolean} moves
 * @returns {import("../core/snap.js").Surroundings}
 */
export function surroundings({ editor, stage, settings }, moves) {
  const { contours } = editor;
  const knots = contours.flatMap((contour, c) => contour.knots.filter((_, k) => !moves(c, k)));
  const still = contours.flatMap((contour, c) => (contour.knots.some((_, k) => moves(c, k)) ? [] : [c]));
  const extrema = settings.values.snap.extrema ? still.flatMap((c) => stage.curves[c].axisExtrema) : [];
  return { knots, extrema, grid: settings.values.grid };
}

/** Pixels within which a point snaps. */
export const SNAP_REACH = 6;

// Draws: a click adds a knot behind the selected end of an open contour, or begins a contour. On a curve it
// inserts a knot where the curve is, so that the curve changes least.

import { contoursOf } from "../core/commands.js";
import { rounded } from "../core/geometry.js";
import { Selection } from "../core/selection.js";
import { snapped, SNAP_REACH, surroundings } from "./tool.js";

/** @typedef {import("./tool.js").Studio} Studio */
/** @typedef {import("./tool.js").Pointer} Pointer */
/** @typedef {import("../core/geometry.js").Point} Point */
/** @typedef {import("../core/document.js").Knot} Knot */

/**
 * The end from which drawing goes on: the selected knot, if it is an end of an open contour.
 * @param {import("../core/commands.js").State} state
 */
export function activeEnd(state) {
  const only = state.selection.only;
  const contour = only && contoursOf(state)[only.contour];
  if (!contour || contour.closed) return null;
  const last = contour.knots.length - 1;
  if (only.knot === last) return { contour: only.contour, atStart: false };
  return only.knot === 0 ? { contour: only.contour, atStart: true } : null;
}

/**
 * The command that puts a knot at a point: behind the active end, or as a new contour.
 * @param {import("../core/commands.js").State} state
 * @param {Knot} knot
 * @returns {[keyof typeof import("../core/commands.js").COMMANDS, any]}
 */
export function placing(state, knot) {
  const end = activeEnd(state);
  return end ? ["addKnot", { ...end, knot }] : ["startContour", { knot }];
}

/**
 * What a press on this knot does to the contour that is being drawn.
 * @param {import("../core/commands.js").State} state
 * @param {import("../core/selection.js").Place} place
 * @returns {[keyof typeof import("../core/commands.js").COMMANDS, any] | null} `null`: only the selection changes
 */
export function meeting(state, place) {
  const end = activeEnd(state);
  const contours = contoursOf(state);
  const target = contours[place.contour];
  if (!end || !target) return null;
  const last = target.knots.length - 1;
  const isOtherEnd = !target.closed && (place.knot === 0 || place.knot === last);
  if (!isOtherEnd) return null;
  if (place.contour !== end.contour) {
    return ["joinContours", { contour: end.contour, atStart: end.atStart, other: place.contour, otherAtStart: place.knot === 0 }];
  }
  const from = end.atStart ? 0 : last;
  return place.knot !== from && last >= 2 ? ["close", { contour: place.contour, closed: true }] : null;
}

/** @param {Studio} studio @param {boolean} shift @returns {Pick<Knot, "join">} a corner, or nothing: the spline's own smooth join */
const joinFor = ({ settings }, shift) => (settings.values.nextIsCorner !== shift ? { join: "corner" } : {});

/** @param {Studio} studio @param {Pointer} at */
function place(studio, at) {
  if (at.ctrl) return { point: { x: rounded(at.point.x), y: rounded(at.point.y) }, lines: [] };
  const around = surroundings(studio, () => false);
  const { point, lines } = snapped(at.point, around, studio.settings.values.snap, SNAP_REACH / studio.stage.viewport.scale);
  return { point: { x: rounded(point.x), y: rounded(point.y) }, lines };
}

/** @type {import("./tool.js").Tool} */
export const draw = {
  id: "draw",
  label: "Draw",
  key: "p",
  icon: "M4 20l3.5-1L18.6 7.9a1.8 1.8 0 0 0 0-2.5l0 0a1.8 1.8 0 0 0-2.5 0L5 16.5 4 20zM14.3 7.2l2.5 2.5",
  hint: "Click adds a smooth knot, ⇧ click a corner. On the curve it inserts one. The first knot closes, Esc ends.",

  hover(studio, at) {
    const { editor, stage } = studio;
    const kept = editor.committed;
    const hit = stage.knotAt(at.screen, at.kind);
    const existing = hit && contoursOf(kept)[hit.contour]?.knots[hit.knot];
    if (hit && existing) {
      editor.cancel();
      const meets = meeting(kept, hit) !== null;
      stage.show({ hover: hit, mark: meets ? { ...existing, closes: true } : null });
      return "pointer";
    }
    editor.cancel();
    const curve = at.ctrl ? null : stage.curveAt(at.screen, at.kind);
    if (curve) {
      stage.show({ mark: { x: curve.x, y: curve.y } });
      return "copy";
    }
    const { point, lines } = place(studio, at);
    const end = activeEnd(kept);
    if (!end) {
      stage.show({ lines, at: point, mark: point });
      return "crosshair";
    }
    // The curve as it will be, before the click.
    editor.preview([placing(kept, { ...point, ...joinFor(studio, at.shift) })]);
    stage.show({ lines, at: point, ghost: editor.selection.only });
    return "crosshair";
  },

  leave({ editor, stage }) {
    editor.cancel();
    stage.show({});
  },

  press(studio, at) {
    const { editor, stage } = studio;
    editor.cancel();
    const kept = editor.committed;
    const hit = stage.knotAt(at.screen, at.kind);
    if (hit) {
      const command = meeting(kept, hit);
      stage.show({ hover: hit });
      if (!command) {
        editor.select(Selection.one(hit.contour, hit.knot));
        return null;
      }
      editor.run(...command);
      if (command[0] === "close") editor.select(Selection.none);
      return null;
    }
    const curve = at.ctrl ? null : stage.curveAt(at.screen, at.kind);
    if (curve) {
      const { default_join, joins } = studio.info(stage.curves[curve.contour].spline);
      // A G4 knot on a curve of cubic curvature leaves the curve as it is.
      const join = joins.includes("g4") ? "g4" : default_join;
      const knot = { x: rounded(curve.x), y: rounded(curve.y), join };
      editor.run("insertKnot", { contour: curve.contour, index: curve.segment + 1, knot });
      return null;
    }
    const show = (/** @type {Pointer} */ now) => {
      const { point, lines } = place(studio, now);
      editor.preview([placing(kept, { ...point, ...joinFor(studio, at.shift) })]);
      stage.show({ lines, at: point });
    };
    show(at);
    return {
      move: show,
      end() {
        editor.commit();
        stage.show({});
      },
      cancel: () => editor.cancel(),
    };
  },
};

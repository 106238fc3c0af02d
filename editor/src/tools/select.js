// Selects and changes: knots, tangents, the frame around several knots, and a marquee.

import { contoursOf, knotAt } from "../core/commands.js";
import { contains, rounded } from "../core/geometry.js";
import { joinInfo } from "../core/joins.js";
import { Selection } from "../core/selection.js";
import { frameMap } from "../view/frame.js";
import { snapped, SNAP_REACH, surroundings } from "./tool.js";

/** @typedef {import("./tool.js").Studio} Studio */
/** @typedef {import("./tool.js").Pointer} Pointer */
/** @typedef {import("./tool.js").Drag} Drag */
/** @typedef {import("../core/selection.js").Place} Place */

/** Pixels that a pointer may move in a click. */
const STILL = 3;

/** @param {Pointer} a @param {Pointer} b */
const isStill = (a, b) => Math.hypot(a.screen.x - b.screen.x, a.screen.y - b.screen.y) < STILL;

/** @param {Studio} studio @param {number} contour @returns {Place[]} */
const wholeContour = ({ editor }, contour) => editor.contours[contour].knots.map((_, knot) => ({ contour, knot }));

/** @type {import("./tool.js").Tool} */
export const select = {
  id: "select",
  label: "Select",
  key: "v",
  icon: "M6 3l12 9-5.2.9L10 19z",
  hint: "Drag knots, tangents, or a frame around knots. Double click a knot to change its join, the curve to insert one.",
  frame: true,

  hover({ stage }, at) {
    const grip = stage.frameHandleAt(at.screen, at.kind);
    if (grip) {
      stage.show({});
      return grip.handle.cursor;
    }
    const knot = stage.knotAt(at.screen, at.kind);
    stage.show({ hover: knot });
    if (knot || stage.handleAt(at.screen, at.kind)) return "pointer";
    return stage.curveAt(at.screen, at.kind) ? "move" : "default";
  },

  leave({ stage }) {
    stage.show({});
  },

  press(studio, at) {
    const { editor, stage } = studio;
    const grip = stage.frameHandleAt(at.screen, at.kind);
    if (grip) return transforming(studio, grip, at);
    const knot = stage.knotAt(at.screen, at.kind);
    if (knot) return pressKnot(studio, knot, at);
    const handle = stage.handleAt(at.screen, at.kind);
    if (handle) return turning(studio, handle);
    const curve = stage.curveAt(at.screen, at.kind);
    if (curve && at.clicks === 2) {
      const { default_join, joins } = studio.info(stage.curves[curve.contour].spline);
      const join = joins.includes("g4") ? "g4" : default_join;
      editor.run("insertKnot", { contour: curve.contour, index: curve.segment + 1, knot: { x: rounded(curve.x), y: rounded(curve.y), join } });
      return null;
    }
    if (curve) {
      const whole = wholeContour(studio, curve.contour);
      const all = whole.every(({ contour, knot }) => editor.selection.has(contour, knot));
      if (at.shift) editor.select(all ? editor.selection.toggled(whole) : editor.selection.with(whole));
      else if (!all) editor.select(Selection.of(whole));
      return moving(studio, at, null);
    }
    if (stage.background.holds(at.point)) return movingPicture(studio, at);
    return marquee(studio, at);
  },
};

/** @param {Studio} studio @param {Place} place @param {Pointer} at @returns {Drag | null} */
function pressKnot(studio, place, at) {
  const { editor, stage } = studio;
  const { contour, knot } = place;
  if (at.clicks === 2 && !at.shift) {
    const join = stage.curves[contour].knots[knot]?.join ?? "g4";
    const { joins } = studio.info(stage.curves[contour].spline);
    let { next } = joinInfo(join);
    while (!joins.includes(next) && next !== join) ({ next } = joinInfo(next));
    editor.select(Selection.one(contour, knot));
    editor.run("setJoin", { join: next });
    studio.say(`${joinInfo(next).words}: ${joinInfo(next).meaning}`);
    return null;
  }
  const was = editor.selection.has(contour, knot);
  if (at.shift) editor.select(editor.selection.toggled([place]));
  else if (!was) editor.select(Selection.one(contour, knot));
  return moving(studio, at, place);
}

/**
 * Moves what is selected; the knot that was pressed snaps.
 * @param {Studio} studio
 * @param {Pointer} from
 * @param {Place | null} place
 * @returns {Drag}
 */
function moving(studio, from, place) {
  const { editor, stage, settings } = studio;
  const kept = editor.committed;
  const around = surroundings(studio, (c, k) => kept.selection.has(c, k));
  const anchor = (place && knotAt(kept, place)) ?? from.point;
  let moved = false;
  return {
    move(at) {
      if (!moved && isStill(from, at)) return;
      moved = true;
      let [dx, dy] = [at.point.x - from.point.x, at.point.y - from.point.y];
      if (at.shift) [dx, dy] = Math.abs(dx) > Math.abs(dy) ? [dx, 0] : [0, dy];
      const target = { x: anchor.x + dx, y: anchor.y + dy };
      const on = at.ctrl ? {} : place ? settings.values.snap : { grid: settings.values.snap.grid };
      const { point, lines } = snapped(target, around, on, SNAP_REACH / stage.viewport.scale);
      // Without a knot under the pointer only the way is on the grid.
      const [wayX, wayY] = place ? [point.x - anchor.x, point.y - anchor.y] : [Math.round(dx), Math.round(dy)];
      editor.preview([["move", { dx: at.shift && dx === 0 ? 0 : wayX, dy: at.shift && dy === 0 ? 0 : wayY }]]);
      stage.show({ hover: place, lines, at: point });
    },
    end(at) {
      if (!moved && place && !at.shift) editor.select(Selection.one(place.contour, place.knot));
      editor.commit();
      stage.show({ hover: place });
    },
    cancel: () => editor.cancel(),
  };
}

/**
 * Turns a tangent; with Alt this side alone.
 * @param {Studio} studio
 * @param {{place: Place, side: "tangent_in" | "tangent_out"}} handle
 * @returns {Drag}
 */
function turning({ editor, stage }, { place, side }) {
  const knot = knotAt(editor.committed, place);
  const other = side === "tangent_in" ? "tangent_out" : "tangent_in";
  if (!knot) return {};
  const both = knot[other] && knot[side] && knot[other][0] === knot[side][0] && knot[other][1] === knot[side][1];
  const sign = side === "tangent_in" ? -1 : 1;
  return {
    move(at) {
      const [dx, dy] = [sign * (at.point.x - knot.x), sign * (at.point.y - knot.y)];
      const length = Math.hypot(dx, dy);
      if (length === 0) return;
      const step = Math.PI / 12;
      const angle = at.shift ? Math.round(Math.atan2(dy, dx) / step) * step : Math.atan2(dy, dx);
      /** @type {[number, number]} */
      const tangent = [rounded(Math.cos(angle), 4), rounded(Math.sin(angle), 4)];
      const fields = both && !at.alt ? { [side]: tangent, [other]: tangent } : { [side]: tangent };
      editor.preview([["setKnotAt", { place, fields }]], "turn tangent");
      stage.show({ hover: place });
    },
    end: () => editor.commit(),
    cancel: () => editor.cancel(),
  };
}

/**
 * @param {Studio} studio
 * @param {{handle: import("../view/frame.js").Handle, box: import("../core/geometry.js").Box}} grip
 * @param {Pointer} from
 * @returns {Drag}
 */
function transforming({ editor, stage }, { handle, box }, from) {
  return {
    move(at) {
      const map = frameMap(handle, box, from.point, at.point, { even: at.shift, fromCentre: at.alt });
      editor.preview([["transform", { map }]], handle.kind);
      stage.show({});
    },
    end: () => editor.commit(),
    cancel: () => editor.cancel(),
  };
}

/** Moves the picture to trace, which is no part of the drawing: there is no undo for it. @param {Studio} studio @param {Pointer} from @returns {Drag} */
function movingPicture({ stage, keeping }, from) {
  const { x, y } = stage.background;
  const to = (/** @type {number} */ dx, /** @type {number} */ dy) => {
    Object.assign(stage.background, { x: x + dx, y: y + dy });
    stage.invalidate();
  };
  return {
    move: (at) => to(at.point.x - from.point.x, at.point.y - from.point.y),
    end: () => keeping.keepPicture(),
    cancel: () => to(0, 0),
  };
}

/** @param {Studio} studio @param {Pointer} from @returns {Drag} */
function marquee({ editor, stage }, from) {
  const before = editor.selection;
  return {
    move(at) {
      const [a, b] = [from.point, at.point];
      const box = { x0: Math.min(a.x, b.x), y0: Math.min(a.y, b.y), x1: Math.max(a.x, b.x), y1: Math.max(a.y, b.y) };
      const inside = contoursOf(editor.state).flatMap(({ knots }, contour) =>
        knots.flatMap((k, knot) => (contains(box, k) ? [{ contour, knot }] : [])));
      editor.select(at.shift ? before.with(inside) : Selection.of(inside));
      stage.show({ marquee: box });
    },
    end(at) {
      if (isStill(from, at) && !at.shift) editor.select(Selection.none);
      stage.show({});
    },
    cancel() {
      editor.select(before);
      stage.show({});
    },
  };
}

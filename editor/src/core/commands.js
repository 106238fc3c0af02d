// Everything that can be done to a drawing: functions from one state to the next, without DOM, by name. The
// history stores states, so that a command needs no inverse.

import { apply, applyToVector, boxOf, mirrors, rounded, translation } from "./geometry.js";
import { blank, choiceOf, defined, replaced, SIDES } from "./document.js";
import { joinInfo } from "./joins.js";
import { Selection } from "./selection.js";

/** @typedef {import("./document.js").Document} Document */
/** @typedef {import("./document.js").Contour} Contour */
/** @typedef {import("./document.js").Knot} Knot */
/** @typedef {import("./document.js").Join} Join */
/** @typedef {import("./document.js").Params} Params */
/** @typedef {import("./geometry.js").Affine} Affine */
/** @typedef {import("./selection.js").Place} Place */
/**
 * What undo brings back: the drawing, which glyph is open, and which of its knots are selected.
 * @typedef {object} State
 * @property {Document} document
 * @property {number} glyph
 * @property {Selection} selection
 */

/** @param {State} state */
export const contoursOf = (state) => state.document.glyphs[state.glyph]?.contours ?? [];

/** @param {State} state @param {Place} place @returns {Knot | undefined} */
export const knotAt = (state, { contour, knot }) => contoursOf(state)[contour]?.knots[knot];

/**
 * @param {State} state
 * @param {readonly Contour[]} contours
 * @param {Selection} [selection]
 * @returns {State}
 */
function withContours(state, contours, selection = state.selection) {
  const glyph = { ...state.document.glyphs[state.glyph], contours };
  return { ...state, document: { ...state.document, glyphs: replaced(state.document.glyphs, state.glyph, glyph) }, selection };
}

/**
 * @param {State} state
 * @param {number} index
 * @param {(contour: Contour) => Contour} change
 * @param {Selection} [selection]
 */
function changeContour(state, index, change, selection) {
  const contours = contoursOf(state);
  return contours[index] ? withContours(state, replaced(contours, index, change(contours[index])), selection) : state;
}

/**
 * Every selected knot changed.
 * @param {State} state
 * @param {(knot: Knot, place: Place) => Knot} change
 */
function changeSelected(state, change) {
  const { selection } = state;
  const contours = contoursOf(state).map((contour, c) =>
    selection.byContour.has(c)
      ? { ...contour, knots: contour.knots.map((knot, k) => (selection.has(c, k) ? change(knot, { contour: c, knot: k }) : knot)) }
      : contour);
  return withContours(state, contours);
}

/** A knot under an affine map; what has a size follows it. @param {Knot} knot @param {Affine} map @returns {Knot} */
function mapped(knot, map) {
  const [a, b, c, d] = map;
  // Exact for similarities, which are all that curvature follows in a simple way.
  const scale = Math.sqrt(Math.abs(a * d - b * c));
  const sign = mirrors(map) ? -1 : 1;
  const curvature = (/** @type {number | undefined} */ k) => (k === undefined ? undefined : (sign * k) / scale);
  const tangent = (/** @type {import("./document.js").Vector | undefined} */ v) => (v ? applyToVector(map, v) : undefined);
  const { x, y } = apply(map, knot);
  return defined({
    ...knot,
    // Far finer than any font's grid, and free of the noise of sines.
    x: rounded(x, 6),
    y: rounded(y, 6),
    tangent_in: tangent(knot.tangent_in),
    tangent_out: tangent(knot.tangent_out),
    curvature_in: curvature(knot.curvature_in),
    curvature_out: curvature(knot.curvature_out),
  });
}

/**
 * A knot whose sides agree where its join says so: after one side has changed, the other follows.
 * @param {Knot} knot
 * @param {Partial<Knot>} changed
 * @returns {Knot}
 */
function agreeing(knot, changed) {
  const { oneDirection, oneCurvature } = joinInfo(knot.join ?? "g4");
  /** @type {any} */
  const agreed = { ...knot };
  const agree = (/** @type {"tangent" | "curvature"} */ what) => {
    const [before, after] = /** @type {const} */ ([`${what}_in`, `${what}_out`]);
    if (agreed[before] === undefined || agreed[after] === undefined) return;
    const leads = before in changed && !(after in changed) ? before : after;
    agreed[before] = agreed[after] = agreed[leads];
  };
  if (oneDirection) agree("tangent");
  if (oneCurvature) agree("curvature");
  return defined(agreed);
}

/** Whether a map can be undone; another would lay knots on one another. @param {Affine} map */
const isRegular = ([a, b, c, d, e, f]) => [a, b, c, d, e, f].every(Number.isFinite) && Math.abs(a * d - b * c) > 1e-12;

/** A contour run through backwards. @param {Contour} contour @returns {Contour} */
export function reversed(contour) {
  const knots = contour.knots.map((knot) => {
    /** @type {any} */
    const turned = { ...knot };
    for (const [here, there] of Object.entries(SIDES)) turned[there] = /** @type {any} */ (knot)[here];
    for (const side of ["tangent_in", "tangent_out"]) turned[side] = turned[side]?.map((/** @type {number} */ v) => -v);
    for (const side of ["curvature_in", "curvature_out"]) if (turned[side] !== undefined) turned[side] = -turned[side];
    if (knot.join) turned.join = joinInfo(knot.join).reversed;
    return /** @type {Knot} */ (defined(turned));
  });
  return { ...contour, knots: knots.reverse() };
}

/** What aligning does with a box: the coordinate that all selected knots get. */
export const EDGES = /** @type {const} */ ({
  left: ["x", (/** @type {import("./geometry.js").Box} */ b) => b.x0],
  centre: ["x", (/** @type {import("./geometry.js").Box} */ b) => (b.x0 + b.x1) / 2],
  right: ["x", (/** @type {import("./geometry.js").Box} */ b) => b.x1],
  bottom: ["y", (/** @type {import("./geometry.js").Box} */ b) => b.y0],
  middle: ["y", (/** @type {import("./geometry.js").Box} */ b) => (b.y0 + b.y1) / 2],
  top: ["y", (/** @type {import("./geometry.js").Box} */ b) => b.y1],
});

/** @param {State} state @returns {Knot[]} */
export const selectedKnots = (state) => state.selection.places.flatMap((place) => knotAt(state, place) ?? []);

/**
 * The table of commands: what it is called in "Undo …", and the function.
 * @type {Record<string, {label: string, run: (state: State, args: any) => State}>}
 */
export const COMMANDS = {
  startContour: {
    label: "new contour",
    /** @param {State} state @param {{knot: Knot}} args */
    run(state, { knot }) {
      const contours = contoursOf(state);
      return withContours(state, [...contours, { closed: false, knots: [knot] }], Selection.one(contours.length, 0));
    },
  },
  addKnot: {
    label: "add knot",
    /** Beyond an end of an open contour. @param {State} state @param {{contour: number, atStart?: boolean, knot: Knot}} args */
    run(state, { contour, atStart = false, knot }) {
      const count = contoursOf(state)[contour]?.knots.length ?? 0;
      return COMMANDS.insertKnot.run(state, { contour, index: atStart ? 0 : count, knot });
    },
  },
  insertKnot: {
    label: "insert knot",
    /** @param {State} state @param {{contour: number, index: number, knot: Knot}} args */
    run(state, { contour, index, knot }) {
      const insert = (/** @type {Contour} */ old) => ({ ...old, knots: old.knots.toSpliced(index, 0, knot) });
      return changeContour(state, contour, insert, Selection.one(contour, index));
    },
  },
  close: {
    label: "close contour",
    /** @param {State} state @param {{contour: number, closed: boolean}} args */
    run: (state, { contour, closed }) => changeContour(state, contour, (old) => ({ ...old, closed })),
  },
  joinContours: {
    label: "join contours",
    /** Open contour `other` hung onto the end of open contour `contour`. @param {State} state @param {{contour: number, atStart: boolean, other: number, otherAtStart: boolean}} args */
    run(state, { contour, atStart, other, otherAtStart }) {
      const contours = contoursOf(state);
      const first = atStart ? reversed(contours[contour]) : contours[contour];
      const second = otherAtStart ? contours[other] : reversed(contours[other]);
      const whole = { ...first, knots: [...first.knots, ...second.knots] };
      const left = replaced(contours, contour, whole).filter((_, i) => i !== other);
      const index = contour - (other < contour ? 1 : 0);
      return withContours(state, left, Selection.one(index, first.knots.length - 1));
    },
  },
  openAt: {
    label: "open contour",
    /** A closed contour begins and ends at the knot, which there are two of then. @param {State} state @param {Place} args */
    run(state, { contour, knot }) {
      const open = (/** @type {Contour} */ old) => {
        const knots = [...old.knots.slice(knot), ...old.knots.slice(0, knot), old.knots[knot]];
        return { ...old, closed: false, knots };
      };
      return contoursOf(state)[contour]?.closed ? changeContour(state, contour, open, Selection.one(contour, 0)) : state;
    },
  },
  startAt: {
    label: "first knot",
    /** @param {State} state @param {Place} args */
    run(state, { contour, knot }) {
      const turn = (/** @type {Contour} */ old) => ({ ...old, knots: [...old.knots.slice(knot), ...old.knots.slice(0, knot)] });
      return contoursOf(state)[contour]?.closed ? changeContour(state, contour, turn, Selection.one(contour, 0)) : state;
    },
  },
  reverse: {
    label: "reverse direction",
    /** @param {State} state */
    run(state) {
      const contours = contoursOf(state).map((contour, c) => (state.selection.byContour.has(c) ? reversed(contour) : contour));
      const places = state.selection.places.map(({ contour, knot }) => ({ contour, knot: contours[contour].knots.length - 1 - knot }));
      return withContours(state, contours, Selection.of(places));
    },
  },
  delete: {
    label: "delete",
    /** The selected knots, and contours that lose all of theirs. @param {State} state */
    run(state) {
      const { selection } = state;
      const contours = contoursOf(state)
        .map((contour, c) => ({ ...contour, knots: contour.knots.filter((_, k) => !selection.has(c, k)) }))
        .filter((contour) => contour.knots.length > 0);
      // The knot before the only one that goes is selected next, so that several can go in a row.
      const only = selection.only;
      const left = only && contoursOf(state)[only.contour].knots.length > 1;
      return withContours(state, contours, left ? Selection.one(only.contour, Math.max(0, only.knot - 1)) : Selection.none);
    },
  },
  move: {
    label: "move",
    /** @param {State} state @param {{dx: number, dy: number}} args */
    run: (state, { dx, dy }) => changeSelected(state, (knot) => mapped(knot, translation(dx, dy))),
  },
  transform: {
    label: "transform",
    /** @param {State} state @param {{map: Affine}} args */
    run: (state, { map }) => (isRegular(map) ? changeSelected(state, (knot) => mapped(knot, map)) : state),
  },
  setJoin: {
    label: "change join",
    /** @param {State} state @param {{join: Join | undefined}} args */
    run: (state, { join }) => changeSelected(state, (knot) => agreeing({ ...knot, join }, {})),
  },
  setKnot: {
    label: "change knot",
    /** Sets fields of the selected knots; `undefined` takes them away. @param {State} state @param {{fields: Partial<Knot>}} args */
    run: (state, { fields }) => changeSelected(state, (knot) => agreeing({ ...knot, ...fields }, fields)),
  },
  setKnotAt: {
    label: "change knot",
    /** @param {State} state @param {{place: Place, fields: Partial<Knot>}} args */
    run: (state, { place, fields }) =>
      changeContour(state, place.contour, (old) => ({
        ...old,
        knots: old.knots.map((knot, k) => (k === place.knot ? agreeing({ ...knot, ...fields }, fields) : knot)),
      })),
  },
  align: {
    label: "align",
    /** @param {State} state @param {{edge: keyof typeof EDGES}} args */
    run(state, { edge }) {
      const box = boxOf(selectedKnots(state));
      const [axis, at] = EDGES[edge];
      return box ? changeSelected(state, (knot) => ({ ...knot, [axis]: at(box) })) : state;
    },
  },
  distribute: {
    label: "distribute",
    /** Equal steps between the outermost. @param {State} state @param {{axis: "x" | "y"}} args */
    run(state, { axis }) {
      const places = state.selection.places;
      const value = (/** @type {Place} */ place) => knotAt(state, place)?.[axis] ?? 0;
      const order = places.toSorted((a, b) => value(a) - value(b));
      if (order.length < 3) return state;
      const [low, high] = [value(order[0]), value(order[order.length - 1])];
      const at = (/** @type {Place} */ place) => {
        const i = order.findIndex((p) => p.contour === place.contour && p.knot === place.knot);
        return low + ((high - low) * i) / (order.length - 1);
      };
      return changeSelected(state, (knot, place) => ({ ...knot, [axis]: rounded(at(place), 6) }));
    },
  },
  paste: {
    label: "paste",
    /** Contours, selected then. @param {State} state @param {{contours: readonly Contour[], dx?: number, dy?: number}} args */
    run(state, { contours, dx = 0, dy = 0 }) {
      const old = contoursOf(state);
      const shifted = contours.map((contour) => ({ ...contour, knots: contour.knots.map((knot) => mapped(knot, translation(dx, dy))) }));
      const places = shifted.flatMap(({ knots }, i) => knots.map((_, knot) => ({ contour: old.length + i, knot })));
      return withContours(state, [...old, ...shifted], Selection.of(places));
    },
  },
  setSpline: {
    label: "change spline",
    /** Of the drawing; contours that name the one that they had, too, follow it. @param {State} state @param {{spline: string, params?: Params}} args */
    run: (state, { spline, params = {} }) => ({ ...state, document: { ...state.document, spline, params } }),
  },
  setContourSpline: {
    label: "change spline of the contour",
    /** Of contours with a selected knot; no spline: the drawing's. @param {State} state @param {{spline: string | undefined, params?: Params}} args */
    run(state, { spline, params }) {
      const contours = contoursOf(state).map((contour, c) =>
        state.selection.byContour.has(c) ? defined({ ...contour, spline, params: spline ? params : undefined }) : contour);
      return withContours(state, contours);
    },
  },
  open: {
    label: "open",
    /** @param {State} _state @param {{document: Document, glyph?: number}} args */
    run: (_state, { document, glyph = 0 }) => ({
      document: document.glyphs.length ? document : { ...document, glyphs: blank().glyphs }, glyph, selection: Selection.none,
    }),
  },
};

/** Contours with at least one selected knot, whole. @param {State} state @returns {Contour[]} */
export const selectedContours = (state) => state.selection.contours.map((c) => contoursOf(state)[c]);

/** @param {State} state @param {number} contour */
export const choiceAt = (state, contour) => choiceOf(state.document, contoursOf(state)[contour]);

// The document: what a designer gives, and the editor's only state that is worth a file. Plain data in
// the shape of the document's JSON, never changed in place, so that keeping an old one is an undo.

/** @typedef {"corner" | "g1" | "g2" | "g4" | "curve-to-terminal" | "terminal-to-curve"} Join */
/** @typedef {[number, number]} Vector */
/**
 * @typedef {object} Knot
 * @property {number} x
 * @property {number} y y is up
 * @property {Join} [join] left out: the spline's own smooth join
 * @property {Vector} [tangent_in]
 * @property {Vector} [tangent_out]
 * @property {number} [curvature_in]
 * @property {number} [curvature_out]
 * @property {number} [tension_in]
 * @property {number} [tension_out]
 * @property {number} [curl]
 */
/** @typedef {Readonly<Record<string, number | string>>} Params */
/**
 * @typedef {object} Contour
 * @property {boolean} closed
 * @property {readonly Knot[]} knots
 * @property {string} [spline] left out: the document's
 * @property {Params} [params]
 */
/** @typedef {{name: string, layer: string, contours: readonly Contour[]}} Glyph */
/** @typedef {{spline: string, params: Params, glyphs: readonly Glyph[]}} Document */
/** A spline of the catalogue with its parameters. @typedef {{spline: string, params: Params}} Choice */

/** The fields of a knot that belong to one side of it, and their fields on the other side. */
export const SIDES = /** @type {const} */ ({
  tangent_in: "tangent_out",
  tangent_out: "tangent_in",
  curvature_in: "curvature_out",
  curvature_out: "curvature_in",
  tension_in: "tension_out",
  tension_out: "tension_in",
});

/** An empty drawing. @returns {Document} */
export const blank = () => ({ spline: "spiro", params: {}, glyphs: [{ name: "", layer: "", contours: [] }] });

/**
 * The spline that a contour is solved with.
 * @param {Document} document
 * @param {Contour} contour
 * @returns {Choice}
 */
export function choiceOf(document, contour) {
  if (contour.spline === undefined && contour.params === undefined) return document;
  return {
    spline: contour.spline ?? document.spline,
    params: contour.params ?? (contour.spline === undefined ? document.params : {}),
  };
}

/** How many segments a contour has. @param {Contour} contour */
export const segmentCount = ({ closed, knots }) => (knots.length < 2 ? 0 : closed ? knots.length : knots.length - 1);

/**
 * A document from the JSON that the formats module writes, whose contents it has checked. Extra keys stay
 * out, `tangent` becomes both tangents.
 * @param {any} json
 * @returns {Document}
 */
export function fromJson(json) {
  const glyphs = json.glyphs ?? [{ contours: json.contours ?? [] }];
  return {
    spline: json.spline ?? "spiro",
    params: json.params ?? {},
    glyphs: glyphs.map((/** @type {any} */ glyph) => ({
      name: glyph.name ?? "",
      layer: glyph.layer ?? "",
      contours: glyph.contours.map(contourFromJson),
    })),
  };
}

/** @param {any} json @returns {Contour} */
function contourFromJson({ closed = false, knots, spline, params }) {
  return defined({ closed, knots: knots.map(knotFromJson), spline, params });
}

/** @param {any} json @returns {Knot} */
function knotFromJson({ tangent, ...knot }) {
  return defined({ ...knot, tangent_in: knot.tangent_in ?? tangent, tangent_out: knot.tangent_out ?? tangent });
}

/**
 * The document's JSON, which every part of faircurve reads.
 * @param {Document} document
 */
export const toJson = ({ spline, params, glyphs }) => ({ faircurve: /** @type {const} */ (1), spline, params, glyphs });

/**
 * The document's JSON as a text with a line for each knot.
 * @param {Document} document
 */
export function toText(document) {
  const indent = 2;
  const lines = JSON.stringify(toJson(document), null, indent);
  // A knot is an object without objects in it: one line.
  return `${lines.replace(/\{\s+("x":[^{}]*?)\s+\}/g, (_, inside) => `{${inside.replace(/\s+/g, " ")}}`)}\n`;
}

/**
 * The same without keys that have no value.
 * @template {object} T
 * @param {T} object
 * @returns {T}
 */
export function defined(object) {
  const entries = Object.entries(object).filter(([, value]) => value !== undefined);
  return /** @type {T} */ (Object.fromEntries(entries));
}

/** The same list with another item at an index. @template T @param {readonly T[]} list @param {number} index @param {T} item @returns {T[]} */
export const replaced = (list, index, item) => list.map((old, i) => (i === index ? item : old));

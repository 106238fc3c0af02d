// The joins of Table 7.1 as a table: words, keys, symbols, and what a double click makes of each.

/** @typedef {import("./document.js").Join} Join */
/** @typedef {"square" | "diamond" | "ring" | "disc" | "half-disc-out" | "half-disc-in"} Symbol */
/**
 * @typedef {object} JoinInfo
 * @property {Join} join
 * @property {string} words
 * @property {string} meaning
 * @property {Symbol} symbol of docs/knot-symbols.md; half discs have their round side towards the curve
 * @property {string} key
 * @property {Join} next what a double click makes of it
 * @property {Join} reversed what it is on the contour run through backwards
 * @property {boolean} oneDirection whether both sides have one direction
 * @property {boolean} oneCurvature whether both sides have one curvature
 */

/** @type {readonly JoinInfo[]} */
export const JOINS = [
  {
    join: "corner", words: "corner", meaning: "the curve may turn; each side ends on its own",
    symbol: "square", key: "1", next: "g4", reversed: "corner", oneDirection: false, oneCurvature: false,
  },
  {
    join: "g2", words: "smooth (G2)", meaning: "direction and curvature are continuous",
    symbol: "ring", key: "2", next: "corner", reversed: "g2", oneDirection: true, oneCurvature: true,
  },
  {
    join: "g4", words: "smoother (G4)", meaning: "so are the first and second derivative of curvature",
    symbol: "disc", key: "3", next: "g2", reversed: "g4", oneDirection: true, oneCurvature: true,
  },
  {
    join: "curve-to-terminal", words: "curve to line", meaning: "the curve before it runs into a straight line without a break of curvature",
    symbol: "half-disc-in", key: "4", next: "terminal-to-curve", reversed: "terminal-to-curve", oneDirection: true, oneCurvature: true,
  },
  {
    join: "terminal-to-curve", words: "line to curve", meaning: "a straight line runs into the curve behind it without a break of curvature",
    symbol: "half-disc-out", key: "5", next: "curve-to-terminal", reversed: "curve-to-terminal", oneDirection: true, oneCurvature: true,
  },
  {
    join: "g1", words: "tangent only (G1)", meaning: "direction is continuous; curvature may jump",
    symbol: "diamond", key: "6", next: "g2", reversed: "g1", oneDirection: true, oneCurvature: false,
  },
];

/** @param {Join} join @returns {JoinInfo} */
export function joinInfo(join) {
  const info = JOINS.find((info) => info.join === join);
  if (!info) throw new Error(`there is no join \`${join}\``);
  return info;
}

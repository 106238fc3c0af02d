// Three drawings to begin with.

/** @typedef {import("./core/document.js").Document} Document */
/** @typedef {import("./core/document.js").Join} Join */
/** @typedef {[x: number, y: number, join?: Join]} Row */

/** @param {boolean} closed @param {Row[]} rows */
const contour = (closed, rows) => ({ closed, knots: rows.map(([x, y, join]) => (join ? { x, y, join } : { x, y })) });

/** @param {string} name @param {string} spline @param {ReturnType<typeof contour>[]} contours @returns {Document} */
const drawing = (name, spline, ...contours) => ({ spline, params: {}, glyphs: [{ name, layer: "", contours }] });

/** What the layers show at first is part of it. @typedef {{name: string, words: string, document: Document, comb?: boolean, plot?: boolean}} Example */

/** @type {readonly Example[]} */
export const EXAMPLES = [
  {
    name: "A letter",
    words: "An a of 25 knots: bowls, a stem with “line to curve”, a terminal. Drag one, and watch the comb.",
    comb: true,
    document: drawing("a", "spiro",
      contour(true, [
        [46, 114, "g4"], [170, -12, "g4"], [333, 68, "corner"], [416, -12, "g4"], [518, 38, "corner"], [508, 56, "corner"], [464, 33, "g4"],
        [420, 112, "curve-to-terminal"], [420, 350, "terminal-to-curve"], [385, 464, "g4"], [236, 512, "g4"], [113, 474, "g4"], [66, 402, "g2"],
        [112, 353, "g2"], [159, 400, "g2"], [173, 460, "g2"], [232, 482, "g4"], [330, 366, "curve-to-terminal"], [330, 302, "corner"], [160, 243, "g2"],
      ]),
      contour(true, [[330, 268, "corner"], [330, 104, "corner"], [224, 44, "g4"], [138, 132, "g4"], [204, 222, "g2"]])),
  },
  {
    name: "A logo",
    words: "A leaf and a wave in a round frame: corners between fair curves, and holes.",
    document: drawing("logo", "spiro",
      contour(true, [[0, 300], [300, 600], [600, 300], [300, 0]]),
      contour(true, [[60, 300], [300, 60], [540, 300], [300, 540]]),
      contour(true, [[150, 190, "corner"], [210, 350, "g4"], [440, 440, "corner"], [400, 240, "g4"]]),
      contour(true, [[190, 215, "corner"], [300, 300, "g4"], [400, 402, "corner"], [340, 270, "g4"]])),
  },
  {
    name: "A road",
    words: "A road of Euler spirals, as surveyors lay it out: curvature is the steering wheel, and its plot has no jump.",
    comb: true,
    plot: true,
    document: drawing("road", "euler",
      contour(false, [[0, 0], [400, 40], [760, 240], [900, 560], [1220, 760], [1580, 640], [1800, 380], [2200, 340]])),
  },
];

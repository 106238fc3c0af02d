// Letters to draw: x, y, and the join where it isn't the spline's own.

import { readFile } from "node:fs/promises";
import { repository } from "./helpers.js";

/** @typedef {import("../src/core/document.js").Join} Join */
/** @typedef {{closed: boolean, knots: {x: number, y: number, join?: Join}[]}[]} Letter */

/** @param {string} path @returns {Promise<Letter>} */
const ofFile = async (path) => JSON.parse(await readFile(repository(path), "utf8")).glyphs[0].contours;

/** @param {[number, number, Join?][]} rows */
const contour = (rows) => ({ closed: true, knots: rows.map(([x, y, join]) => ({ x, y, join: join ?? /** @type {const} */ ("g4") })) });

/** @type {Letter} */
const g = [
  contour([
    [440, 500, "corner"], [440, -50, "terminal-to-curve"], [232, -230], [60, -160, "corner"], [84, -118, "corner"], [228, -186], [360, -50, "curve-to-terminal"],
    [360, 70, "corner"], [216, -12], [40, 246], [216, 512], [360, 440, "corner"], [360, 500, "corner"],
  ]),
  contour([[360, 390, "corner"], [360, 120, "corner"], [236, 30], [124, 246], [236, 474]]),
];

export const letters = async () => ({ a: await ofFile("examples/a.json"), g, s: await ofFile("examples/s.json") });

// The package's second module, which reads and writes files; loaded when it is first needed.

import { fromJson, toJson } from "../core/document.js";

/** @typedef {import("../core/document.js").Document} Document */

const formats = () => import("faircurve/formats");

/** Loads it before it is needed. */
export const load = async () => void (await formats());

/**
 * Reads a file. Throws an error with a `hint` where it isn't one.
 * @param {Uint8Array | string} contents
 * @param {string} name a file's, or a format's
 * @returns {Promise<Document>}
 */
export async function readFile(contents, name) {
  return fromJson((await formats()).read(contents, name));
}

/** Names of files that can be opened, for a file picker. */
export async function readable() {
  return (await formats()).formats.flatMap(({ extensions }) => extensions.map((end) => `.${end}`));
}

/** Whether a file of this name can be written, too. @param {string} name */
export async function isWritable(name) {
  const end = name.split(".").pop()?.toLowerCase() ?? "";
  return (await formats()).formats.some(({ extensions, writes }) => writes && extensions.includes(end));
}

/** @param {Document} document @param {string} name */
export async function writeFile(document, name) {
  return (await formats()).write(toJson(document), name);
}

/**
 * A picture of the curves, as the program `faircurve` draws it; holes are holes as on the canvas, whichever way
 * contours run.
 * @param {Document} document
 * @param {number} accuracy
 */
export async function writeSvg(document, accuracy) {
  return (await formats()).svg(toJson(document), { accuracy }).replace("<svg ", '<svg fill-rule="evenodd" ');
}

/** SVG path data. @param {Document} document @param {number} accuracy */
export async function writePath(document, accuracy) {
  return (await formats()).path(toJson(document), { accuracy });
}

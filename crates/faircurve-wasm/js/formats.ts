/**
 * Files: a module of WebAssembly of their own, loaded when this is imported.
 *
 * ```js
 * const { read, svg } = await import("faircurve/formats");
 * const document = read(bytes, "a.sfd");
 * ```
 * @module
 */
import * as wasm from "./wasm/formats.js";
import { start } from "./start.js";
import { checked } from "./error.js";
import type { Document } from "./document.js";

await start(wasm, new URL("./wasm/formats_bg.wasm", import.meta.url));

/** A format of documents. */
export interface Format {
  name: string;
  /** One line. */
  summary: string;
  /** How names of such files end, without the dot. */
  extensions: string[];
  /** Whether documents can be written in it. */
  writes: boolean;
}

/** Every format that is read. */
export const formats: readonly Format[] = wasm.formats() as Format[];

/**
 * Reads a whole file.
 * @param name the file's name, which tells the format by its end, or a format's name
 * @returns the document, always with `glyphs`
 *
 * Throws a `FaircurveError` with the place in the file.
 */
export function read(file: Uint8Array | ArrayBuffer | string, name: string): Document {
  const bytes = typeof file === "string" ? new TextEncoder().encode(file) : new Uint8Array(file);
  return JSON.parse(checked(() => wasm.read(bytes, name))) as Document;
}

/**
 * Writes a whole file.
 * @param format a format's name, or a file's name that tells it by its end
 *
 * Throws a `FaircurveError` where the document holds more than the format can.
 */
export function write(document: Document, format: string): string {
  return checked(() => wasm.write(json(document), format));
}

/** How curves become what is written. */
export interface WriteOptions {
  /** The largest distance of Béziers from the curve; left out: 1/10000 of the glyph's larger side. */
  accuracy?: number;
  /** How far to search for hard contours; 1 if left out. */
  effort?: number;
}

/** A picture of the solved document. */
export function svg(document: Document, options: WriteOptions & { knots?: boolean; comb?: boolean } = {}): string {
  const { accuracy = NaN, effort = 1, knots = false, comb = false } = options;
  return checked(() => wasm.svg(json(document), accuracy, effort, knots, comb));
}

/** SVG path data, a line for each glyph. y is not turned over. */
export function path(document: Document, options: WriteOptions = {}): string {
  return checked(() => wasm.path(json(document), options.accuracy ?? NaN, options.effort ?? 1));
}

/**
 * The solution in numbers, as JSON.
 * @param options with `samples`, so many equal steps of arc length in each segment
 */
export function solution(document: Document, options: WriteOptions & { samples?: number } = {}): string {
  const { accuracy = NaN, effort = 1, samples = 0 } = options;
  return checked(() => wasm.solution(json(document), accuracy, effort, samples));
}

/** A document as its file is; the version may be left out in memory. */
function json(document: Document): string {
  return JSON.stringify({ faircurve: 1, ...document });
}

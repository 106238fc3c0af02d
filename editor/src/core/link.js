// A drawing in a link: its JSON, compressed, in the part of the address that no server sees.

/** @typedef {import("./document.js").Document} Document */
import { toJson } from "./document.js";

const KEY = "#d=";
/** A drawing that unfolds to more than this isn't opened: a small link can't be made to fill the memory. */
const LARGEST = 8e6;

/** @param {Document} document @returns {Promise<string>} the fragment, with its `#` */
export async function toFragment(document) {
  const packed = await through(new TextEncoder().encode(JSON.stringify(toJson(document))), new CompressionStream("deflate-raw"), Infinity);
  const text = Array.from(packed, (byte) => String.fromCharCode(byte)).join("");
  return KEY + btoa(text).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
}

/**
 * The JSON text of a fragment's drawing, still to be read with care; `null` if it holds none.
 * @param {string} fragment
 * @returns {Promise<string | null>}
 */
export async function fromFragment(fragment) {
  if (!fragment.startsWith(KEY)) return null;
  try {
    const text = atob(fragment.slice(KEY.length).replace(/-/g, "+").replace(/_/g, "/"));
    const packed = Uint8Array.from(text, (c) => c.charCodeAt(0));
    const bytes = await through(packed, new DecompressionStream("deflate-raw"), LARGEST);
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    throw Object.assign(new Error("the link's drawing is damaged"), { hint: "copy the whole link, up to its last character" });
  }
}

/** @param {Uint8Array<ArrayBuffer>} bytes @param {CompressionStream | DecompressionStream} stream @param {number} limit */
async function through(bytes, stream, limit) {
  const reader = new Blob([bytes]).stream().pipeThrough(stream).getReader();
  /** @type {Uint8Array[]} */
  const parts = [];
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > limit) {
      await reader.cancel();
      throw new Error("too large");
    }
    parts.push(value);
  }
  const whole = new Uint8Array(size);
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return whole;
}

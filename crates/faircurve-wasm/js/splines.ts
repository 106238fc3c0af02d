/**
 * All splines: a module of WebAssembly that is loaded when this is imported. `spiro`, `euler` and `hobby` are there
 * without it.
 *
 * ```js
 * import "faircurve/splines"; // or, when they are needed: await import("faircurve/splines");
 * ```
 * @module
 */
import * as wasm from "./wasm/splines.js";
import { start } from "./start.js";
import { addSplines } from "./index.js";

await start(wasm, new URL("./wasm/splines_bg.wasm", import.meta.url));
addSplines(wasm);

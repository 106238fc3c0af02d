/**
 * All splines: a second module of WebAssembly, loaded when this is imported. `spiro`, `euler` and `hobby` are there
 * without it.
 *
 * ```js
 * import "faircurve/splines"; // or, when they are needed: await import("faircurve/splines");
 * ```
 * @module
 */
import * as wasm from "./wasm/splines.js";
import { start } from "./start.js";
import { add } from "./index.js";

await start(wasm, new URL("./wasm/splines_bg.wasm", import.meta.url));
add(wasm);

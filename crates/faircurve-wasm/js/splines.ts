/**
 * All splines: a second module of WebAssembly, loaded when this is imported. `spiro`, `euler` and `hobby` are there
 * without it.
 *
 * ```js
 * import "faircurve/splines"; // or, when they are needed: await import("faircurve/splines");
 * ```
 * @module
 */
import init, * as wasm from "./wasm/splines.js";
import { bytesOf } from "./bytes.js";
import { add } from "./solver.js";

await init({ module_or_path: bytesOf(new URL("./wasm/splines_bg.wasm", import.meta.url)) });
add(wasm);

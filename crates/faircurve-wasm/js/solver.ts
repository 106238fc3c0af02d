// The solver module, started once when the package is loaded.
import init, * as wasm from "./wasm/solver.js";
import { bytesOf } from "./bytes.js";

await init({ module_or_path: bytesOf(new URL("./wasm/solver_bg.wasm", import.meta.url)) });

export { wasm };

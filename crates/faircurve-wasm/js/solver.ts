// The modules of WebAssembly that solve: the first, started when the package is loaded, and that of all splines,
// once `splines.ts` is imported.
import * as wasm from "./wasm/solver.js";
import { start } from "./start.js";
import { catalogue } from "./catalogue.js";
import { FaircurveError } from "./error.js";

await start(wasm, new URL("./wasm/solver_bg.wasm", import.meta.url));

/** What each of them does. */
export type Solver = Pick<typeof wasm, "Choice" | "Live" | "solve">;

const FIRST = wasm.splines() as string[];
const NAMES = catalogue.map(({ name }) => name);
let all: Solver | undefined;

/** All splines are solved by this module from now on, but those that the first one has. */
export function addSplines(module: Solver): void {
  all = module;
}

/** The module that has the spline. */
export function solverOf(spline: string): Solver {
  if (FIRST.includes(spline)) return wasm;
  if (!NAMES.includes(spline)) {
    throw new FaircurveError(`there is no spline \`${spline}\``, wasm.suggest(spline, NAMES));
  }
  if (all === undefined) {
    throw new FaircurveError(
      `the module that has spline \`${spline}\` isn't loaded`,
      'load it once, with `import "faircurve/splines"` or `await import("faircurve/splines")`',
    );
  }
  return all;
}

export { wasm };

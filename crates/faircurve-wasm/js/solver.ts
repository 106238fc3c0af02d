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
let all: Solver | undefined;

/** Has all splines from now on. */
export function add(module: Solver): void {
  all = module;
}

/** The module that has the spline. */
export function solverOf(spline: string): Solver {
  if (FIRST.includes(spline)) return wasm;
  const names = catalogue.map(({ name }) => name);
  if (!names.includes(spline)) {
    throw new FaircurveError(`there is no spline \`${spline}\``, wasm.suggest(spline, names));
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

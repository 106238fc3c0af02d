// Knots as rows of numbers, for the solver.
import { FaircurveError } from "./error.js";
import type { Knot, SplineChoice } from "./document.js";
import { type Solver, solverOf, wasm } from "./solver.js";

const JOINS = wasm.joins() as string[];
/** What a knot may have, and where in a row it goes; `tangent` stands for those of both sides. */
const KEYS = new Map([
  ["x", 0], ["y", 1], ["join", 2], ["tangent", 3], ["tangent_in", 3], ["tangent_out", 5],
  ["curvature_in", 7], ["curvature_out", 8], ["tension_in", 9], ["tension_out", 10], ["curl", 11],
]);
/** Numbers in a row. */
const ROW = 12;

/** The name of the join of that number. */
export function joinName(code: number): string {
  return JOINS[code] ?? "corner";
}

let room = new Float64Array(ROW * 64);
let rows = room;

/** The rows of all knots, until the next call. `place` starts messages: `contour 2`. */
export function knotRows(knots: readonly Knot[], place?: () => string): Float64Array {
  const size = ROW * knots.length;
  if (size > room.length) room = new Float64Array(2 * size);
  if (size !== rows.length) rows = room.subarray(0, size);
  rows.fill(NaN);
  for (let index = 0; index < knots.length; index++) {
    try {
      writeRow(rows, ROW * index, knots[index]!);
    } catch (error) {
      if (!(error instanceof FaircurveError)) throw error;
      throw new FaircurveError(`${place ? `${place()}, ` : ""}knot ${index}: ${error.message}`, error.hint);
    }
  }
  return rows;
}

/** The row of one knot. */
export function knotRow(knot: Knot): Float64Array {
  const row = new Float64Array(ROW).fill(NaN);
  writeRow(row, 0, knot);
  return row;
}

/** Writes what is given into a row of NaN. */
function writeRow(rows: Float64Array, at: number, knot: Knot): void {
  if (typeof knot !== "object" || knot === null) throw wrongType("a knot", "an object", knot);
  for (const key in knot) {
    // Most knots have nothing else.
    if (key === "x") {
      if (knot.x !== undefined) rows[at] = number(knot.x, key);
      continue;
    } else if (key === "y") {
      if (knot.y !== undefined) rows[at + 1] = number(knot.y, key);
      continue;
    }
    const column = KEYS.get(key);
    if (column === undefined) {
      throw new FaircurveError(`there is no key \`${key}\` here`, wasm.suggest(key, [...KEYS.keys()]));
    }
    const value = knot[key as keyof Knot];
    if (value === undefined) continue;
    if (key === "join") {
      rows[at + column] = joinCode(value);
    } else if (key === "tangent") {
      if ((knot.tangent_in ?? knot.tangent_out) !== undefined) {
        throw new FaircurveError(
          `\`tangent\` gives both sides, so no other may be given`,
          "give `tangent`, or `tangent_in` and `tangent_out`",
        );
      }
      for (const side of ["tangent_in", "tangent_out"]) vector(rows, at + KEYS.get(side)!, value, side);
    } else if (key === "tangent_in" || key === "tangent_out") {
      vector(rows, at + column, value, key);
    } else {
      rows[at + column] = number(value, key);
    }
  }
  if (knot.x === undefined || knot.y === undefined) {
    throw new FaircurveError(`the key \`${knot.x === undefined ? "x" : "y"}\` is missing`);
  }
}

function joinCode(join: unknown): number {
  if (typeof join !== "string") throw wrongType("`join`", "a string", join);
  const code = JOINS.indexOf(join);
  if (code < 0) throw new FaircurveError(`there is no join \`${join}\``, wasm.suggest(join, JOINS));
  return code;
}

function vector(rows: Float64Array, at: number, value: unknown, key: string): void {
  if (!Array.isArray(value) || value.length !== 2) {
    throw wrongType(`\`${key}\``, "a vector such as [1, 0]", value);
  }
  rows[at] = number(value[0], key);
  rows[at + 1] = number(value[1], key);
}

/** A number as it is; NaN, which would stand for nothing, as the infinity that is refused in its place. */
function number(value: unknown, key: string): number {
  if (typeof value !== "number") throw wrongType(`\`${key}\``, "a number", value);
  return Number.isNaN(value) ? Infinity : value;
}

export function wrongType(what: string, expected: string, got: unknown): FaircurveError {
  const kind =
    got === undefined ? "left out" : got === null ? "null" : Array.isArray(got) ? "a list" : typeof got === "object" ? "an object" : `a ${typeof got}`;
  return new FaircurveError(`${what} must be ${expected}, not ${kind}`);
}

/** A spline of a choice, and the module that has it. */
interface BuiltSpline {
  name: string;
  built: wasm.Built;
  solver: Solver;
}

const known = new Map<string, BuiltSpline>();

/** The spline of a choice, built once for each. */
export function splineOf(choice: SplineChoice, otherwise: SplineChoice = {}): BuiltSpline {
  const name = choice.spline ?? otherwise.spline ?? "spiro";
  const params = choice.params ?? (choice.spline === undefined ? otherwise.params : undefined) ?? {};
  if (typeof name !== "string") throw wrongType("`spline`", "a string", name);
  if (typeof params !== "object") throw wrongType("`params`", "an object", params);
  const key = Object.keys(params).length === 0 ? name : JSON.stringify([name, params]);
  let spline = known.get(key);
  if (spline === undefined) {
    const solver = solverOf(name);
    const wanted = new solver.Choice();
    for (const [param, value] of Object.entries(params)) {
      if (typeof value === "number") wanted.number(param, value);
      else if (typeof value === "string") wanted.text(param, value);
      else throw wrongType(`parameter \`${param}\``, "a number or a string", value);
    }
    spline = { name, built: wanted.build(name), solver };
    // A slider makes many; the oldest is forgotten.
    if (known.size >= 256) {
      const [oldest] = known.keys();
      known.get(oldest!)!.built.free();
      known.delete(oldest!);
    }
    known.set(key, spline);
  }
  return spline;
}

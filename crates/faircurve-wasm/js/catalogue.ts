import type { Join } from "./document.js";
import { rows } from "./wasm/catalogue.js";

/** A parameter that a spline takes. */
export type ParamSpec = {
  name: string;
  /** One line. */
  summary: string;
} & (
  | { kind: "number"; default: number; min: number; max: number }
  | { kind: "choice"; default: string; options: string[] }
  | { kind: "text"; default: string }
);

/** A spline of the catalogue. */
export interface SplineInfo {
  name: string;
  /** One line. */
  summary: string;
  /** Where it is defined. */
  source: string;
  params: ParamSpec[];
  /** The join of a knot that names none. */
  default_join: Join;
  /** The joins that it has; others are adapted. */
  joins: Join[];
  /** What holds at free ends, the default first. */
  ends: string[];
  /** The properties that it claims. */
  claims: string[];
  /** The order of geometric continuity that it claims; 0 where it claims none. */
  continuity: number;
}

/** Every spline with its parameters, in the order in which lists show them, whether its module is loaded or not. */
export const catalogue = rows;

// The tools, in the order of the rail.

import { draw } from "./draw.js";
import { hand } from "./hand.js";
import { select } from "./select.js";

/** @type {readonly import("./tool.js").Tool[]} */
export const TOOLS = [select, draw, hand];

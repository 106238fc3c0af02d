// What TypeScript must accept of the package's types, whole: see types.test.js.
import { catalogue, FaircurveError, LiveContour, solve, type Curve, type SplineInfo } from "faircurve";
import { curveFair } from "faircurve/d3";
import { formats, read } from "faircurve/formats";
import { spiroToBezier, type Knot } from "faircurve/spiro";
import "faircurve/splines";

const info: SplineInfo | undefined = catalogue[0];
const live = new LiveContour({ knots: [{ x: 0, y: 0 }, { x: 1, y: 1, join: "g2" }] });
live.restore(live.snapshot());
const curve: Curve | undefined = solve({ contours: [live.contour] }).contours[0];
const theirs: Knot<undefined>[] = [{ x: 0, y: 0, type: "g4" }];
export const all = [info?.continuity, curve?.length, curveFair.spline("hobby"), formats, read, theirs, spiroToBezier, FaircurveError];
// @ts-expect-error: there is no such join.
live.change(0, { join: "g3" });

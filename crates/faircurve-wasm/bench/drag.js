// A knot of a glyph is dragged: solve and Béziers, step by step. Runs in Node and in a browser.
import { LiveContour, solve } from "faircurve";
import { outline, quantile } from "./drawings.js";

/** Times in ms, by `clock`, of `steps` moves of one knot of a closed contour: middle, 99th percentile, longest; and from anew. */
export function drag({ knots = 250, steps = 1000, spline = "spiro", join, far = 0.5, clock = () => performance.now() }) {
  const contour = { spline, closed: true, knots: outline(knots, 7).map((knot) => ({ ...knot, join })) };
  const live = new LiveContour(contour);
  const { x, y } = contour.knots[100];
  const times = [];
  // Half as many again before, while the engine still compiles; around its place, by up to `far` of the distance to the next.
  const spacing = Math.hypot(contour.knots[101].x - x, contour.knots[101].y - y);
  for (let i = -steps / 2; i < steps; i++) {
    const angle = (2 * Math.PI * i) / 90;
    const reach = spacing * far * (0.4 + 0.6 * Math.sin(i / 40) ** 2);
    const start = clock();
    live.move(100, x + reach * Math.cos(angle), y + reach * Math.sin(angle));
    const { data } = live.beziers(0.1);
    if (i >= 0) times.push(clock() - start);
    if (!data.every(Number.isFinite)) throw new Error("a number isn't finite");
  }
  const anew = [];
  for (let i = 0; i < 40; i++) {
    const start = clock();
    const [curve] = solve({ contours: [live.contour] }).contours;
    curve.beziers(0.1);
    anew.push(clock() - start);
    curve.free();
  }
  const numbers = [quantile(times, 0.5), quantile(times, 0.99), Math.max(...times), quantile(anew, 0.5)];
  live.free();
  return numbers.map((time) => time.toFixed(3));
}

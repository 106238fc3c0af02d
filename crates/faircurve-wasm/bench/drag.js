// A knot of a glyph is dragged: solve and Béziers, step by step. Runs in Node and in a browser.
import { LiveContour, solve } from "faircurve";
import { outline, quantile } from "./drawings.js";

/** Times in ms of `steps` moves of one knot of a closed contour. */
export function drag({ knots = 250, steps = 1000, spline = "spiro", join }) {
  const contour = { spline, closed: true, knots: outline(knots, 7).map((knot) => ({ ...knot, join })) };
  const live = new LiveContour(contour);
  const { x, y } = contour.knots[100];
  const times = [];
  for (let i = 0; i < steps; i++) {
    const angle = (2 * Math.PI * i) / 90;
    const reach = 5 + 10 * Math.sin(i / 40) ** 2;
    const start = performance.now();
    live.move(100, x + reach * Math.cos(angle), y + reach * Math.sin(angle));
    const { data } = live.beziers(0.1);
    times.push(performance.now() - start);
    if (!data.every(Number.isFinite)) throw new Error("a number isn't finite");
  }
  const anew = [];
  for (let i = 0; i < 40; i++) {
    const start = performance.now();
    const [curve] = solve({ contours: [live.contour] }).contours;
    curve.beziers(0.1);
    anew.push(performance.now() - start);
    curve.free();
  }
  const numbers = [quantile(times, 0.5), quantile(times, 0.99), Math.max(...times), quantile(anew, 0.5)];
  live.free();
  return numbers.map((time) => time.toFixed(3));
}

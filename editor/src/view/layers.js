// The layers of the canvas, from the paper up: records that draw one thing each. A layer that the user may
// hide has a label; `isOn` says whether it is drawn.

import { joinInfo } from "../core/joins.js";
import { distance } from "../core/geometry.js";
import { inDrawing, isSelected, joinAt, seenAccuracy } from "./scene.js";
import { drawSymbol } from "./symbols.js";
import { combPath } from "./comb.js";
import { frameHandles } from "./frame.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {{id: string, label?: string, key?: string, hint?: string, isOn?: (scene: Scene) => boolean, draw: (scene: Scene) => void}} Layer */

/** Steps of grids in units, of which the finest that isn't crowded is drawn. */
const GRID_STEPS = [1, 10, 100, 1000, 10000];
/** Pixels between lines below which a grid is crowded. */
const CROWDED = 9;

/** @type {readonly Layer[]} */
export const LAYERS = [
  { id: "background", draw: (scene) => scene.background.draw(scene) },
  { id: "grid", label: "Grid", key: "g", hint: "units and axes", draw: drawGrid },
  { id: "fill", label: "Fill", key: "f", hint: "inside of closed contours", draw: drawFill },
  { id: "compared", isOn: ({ compared }) => compared.length > 0, draw: drawCompared },
  { id: "comb", label: "Curvature comb", key: "c", hint: "curvature as teeth", draw: drawComb },
  { id: "curve", draw: drawCurve },
  { id: "beziers", label: "Béziers", key: "b", hint: "the cubics that are written", draw: drawBeziers },
  { id: "extrema", label: "Extrema, inflections", key: "e", hint: "where curvature is largest, least or zero", draw: drawExtrema },
  { id: "handles", label: "Tangents", hint: "given directions", draw: drawHandles },
  { id: "knots", label: "Knots", key: "k", hint: "symbols of joins", draw: drawKnots },
  { id: "overlay", draw: drawOverlay },
];

/** @param {Scene} scene */
export function drawLayers(scene) {
  const { layers } = scene.settings;
  for (const layer of LAYERS) {
    const isOn = layer.isOn ? layer.isOn(scene) : layer.label === undefined || layers[layer.id];
    if (isOn) layer.draw(scene);
  }
}

/** @param {Scene} scene */
function drawGrid({ context, viewport, colours }) {
  const step = GRID_STEPS.find((step) => step * viewport.scale >= CROWDED);
  const { x0, y0, x1, y1 } = viewport.box;
  context.lineWidth = 1;
  const line = (/** @type {boolean} */ upright, /** @type {number} */ at, /** @type {string} */ colour) => {
    const p = viewport.toScreen({ x: at, y: at });
    const [x, y] = [Math.round(p.x) + 0.5, Math.round(p.y) + 0.5];
    context.strokeStyle = colour;
    if (upright) strokeLine(context, { x, y: 0 }, { x, y: viewport.height });
    else strokeLine(context, { x: 0, y }, { x: viewport.width, y });
  };
  if (step) {
    for (let i = Math.ceil(x0 / step); i * step <= x1; i++) if (i !== 0) line(true, i * step, i % 10 === 0 ? colours.gridStrong : colours.grid);
    for (let i = Math.ceil(y0 / step); i * step <= y1; i++) if (i !== 0) line(false, i * step, i % 10 === 0 ? colours.gridStrong : colours.grid);
  }
  line(true, 0, colours.axis);
  line(false, 0, colours.axis);
}

/** @param {Scene} scene */
function drawFill(scene) {
  const { context, contours, curves, colours, viewport } = scene;
  const whole = new Path2D();
  contours.forEach(({ closed }, i) => closed && whole.addPath(curves[i].path2d(seenAccuracy(viewport))));
  inDrawing(scene, () => {
    context.fillStyle = colours.fill;
    context.fill(whole, "evenodd");
  });
}

/** @param {Scene} scene */
function drawCompared(scene) {
  const { context, compared, viewport } = scene;
  inDrawing(scene, (pixel) => {
    context.lineWidth = 1.6 * pixel;
    for (const { colour, curves } of compared) {
      context.strokeStyle = colour;
      for (const curve of curves) context.stroke(curve.path2d(seenAccuracy(viewport)));
    }
  });
}

/** @param {Scene} scene */
function drawComb(scene) {
  const { context, curves, colours, settings, combReference } = scene;
  if (combReference === 0) return;
  inDrawing(scene, (pixel) => {
    // Teeth keep their length in pixels, whatever the zoom.
    const amplitude = (settings.comb * pixel) / combReference;
    for (const curve of curves) {
      const { teeth, rim } = combPath(curve, amplitude, 2.5 * settings.comb * pixel);
      context.strokeStyle = colours.combTeeth;
      context.lineWidth = 0.8 * pixel;
      context.stroke(teeth);
      context.strokeStyle = colours.comb;
      context.lineWidth = 1.2 * pixel;
      context.stroke(rim);
    }
  });
}

/** @param {Scene} scene */
function drawCurve(scene) {
  const { context, curves, colours, viewport, compared } = scene;
  inDrawing(scene, (pixel) => {
    context.lineJoin = "round";
    context.lineCap = "round";
    for (const curve of curves) {
      const relaxed = curve.relaxed.length > 0;
      context.lineWidth = (compared.length > 0 ? 1.4 : 1.8) * pixel;
      context.strokeStyle = relaxed ? colours.relaxed : colours.curve;
      context.setLineDash(relaxed ? [7 * pixel, 5 * pixel] : []);
      context.stroke(curve.path2d(seenAccuracy(viewport)));
    }
  });
}

/** @param {Scene} scene */
function drawBeziers(scene) {
  const { context, curves, colours, viewport, settings } = scene;
  context.lineWidth = 1;
  for (const curve of curves) {
    // Those of a curve in the hand must not hold up the hand.
    if (scene.isInHand && !curve.isQuick(settings.accuracy)) continue;
    /** @type {Point | null} */
    let last = null;
    const joint = (/** @type {Point} */ p) => {
      context.fillStyle = colours.bezier;
      context.fillRect(p.x - 2.5, p.y - 2.5, 5, 5);
    };
    const arm = (/** @type {Point} */ p, /** @type {Point} */ q) => {
      context.strokeStyle = colours.bezierArm;
      strokeLine(context, p, q);
      circle(context, q, 2.2);
      context.strokeStyle = colours.bezier;
      context.stroke();
    };
    for (const { command, points } of curve.beziers(settings.accuracy).elements) {
      const at = points.map((p) => viewport.toScreen(p));
      if (command === "cubic" && last) {
        arm(last, at[0]);
        arm(at[2], at[1]);
      }
      last = at.at(-1) ?? last;
      if (at.length > 0) joint(at[at.length - 1]);
    }
  }
}

/** @param {Scene} scene */
function drawExtrema({ context, curves, colours, viewport }) {
  for (const curve of curves) {
    for (const p of curve.curvatureExtrema) {
      const { x, y } = viewport.toScreen(p);
      circle(context, { x, y }, 3);
      context.fillStyle = colours.extremum;
      context.fill();
    }
    for (const p of curve.inflections) {
      const { x, y } = viewport.toScreen(p);
      context.beginPath();
      context.moveTo(x - 4, y - 4);
      context.lineTo(x + 4, y + 4);
      context.moveTo(x + 4, y - 4);
      context.lineTo(x - 4, y + 4);
      context.strokeStyle = colours.extremum;
      context.lineWidth = 1.8;
      context.stroke();
    }
  }
}

/** Pixels from a knot to the end of its tangent. */
export const HANDLE = 46;

/**
 * Where the ends of a knot's tangents are, on the screen.
 * @param {import("./viewport.js").Viewport} viewport
 * @param {import("../core/document.js").Knot} knot
 */
export function handlesOf(viewport, knot) {
  const at = viewport.toScreen(knot);
  return /** @type {const} */ (["tangent_in", "tangent_out"]).flatMap((side) => {
    const tangent = knot[side];
    if (!tangent) return [];
    const length = Math.hypot(...tangent) * (side === "tangent_in" ? -1 : 1);
    const tip = { x: at.x + (tangent[0] / length) * HANDLE, y: at.y - (tangent[1] / length) * HANDLE };
    return [{ side, tip, at }];
  });
}

/** @param {Scene} scene */
function drawHandles(scene) {
  const { context, contours, colours, viewport } = scene;
  context.lineWidth = 1.2;
  contours.forEach(({ knots }) => knots.forEach((knot) => {
    for (const { tip, at } of handlesOf(viewport, knot)) {
      context.strokeStyle = colours.handle;
      strokeLine(context, at, tip);
      circle(context, tip, 4);
      context.fillStyle = colours.paper;
      context.fill();
      context.stroke();
    }
  }));
}

/** @param {Scene} scene */
function drawKnots(scene) {
  const { context, contours, curves, colours, viewport, overlay } = scene;
  contours.forEach(({ knots, closed }, contour) => {
    const relaxed = new Set(curves[contour].relaxed.flatMap(({ knot }) => (knot === undefined ? [] : [knot])));
    knots.forEach((knot, k) => {
      const place = { contour, knot: k };
      const isEnd = !closed && knots.length > 1 && (k === 0 || k === knots.length - 1);
      const info = joinInfo(joinAt(scene, place));
      const name = isEnd ? (k === 0 ? "triangle" : "bar") : info.symbol;
      const solved = curves[contour].knots[k];
      const direction = solved?.direction_out ?? solved?.direction_in ?? 0;
      const { x, y } = viewport.toScreen(knot);
      const selected = isSelected(scene, place);
      const hovered = overlay.hover?.contour === contour && overlay.hover.knot === k;
      const ghost = overlay.ghost?.contour === contour && overlay.ghost.knot === k;
      const ink = relaxed.has(k) ? colours.relaxed : selected && !ghost ? colours.selected : colours.knot;
      if (selected && !ghost) {
        circle(context, { x, y }, 9.5);
        context.fillStyle = colours.selectedHalo;
        context.fill();
      }
      context.globalAlpha = ghost ? 0.45 : 1;
      drawSymbol(context, name, { x, y, direction, size: hovered || selected ? 1.15 : 0.9, ink, paper: colours.paper });
      context.globalAlpha = 1;
    });
  });
}

/** @param {Scene} scene */
function drawOverlay(scene) {
  const { context, overlay, colours, viewport } = scene;
  context.lineWidth = 1;
  if (overlay.lines && overlay.at) {
    context.strokeStyle = colours.snap;
    context.setLineDash([4, 4]);
    const at = viewport.toScreen(overlay.at);
    for (const { axis, value, from } of overlay.lines) {
      const far = from && distance(viewport.toScreen(from), at) > 1 ? viewport.toScreen(from) : null;
      const p = viewport.toScreen({ x: value, y: value });
      context.beginPath();
      if (far) {
        context.moveTo(far.x, far.y);
        context.lineTo(at.x, at.y);
      } else if (axis === "x") {
        context.moveTo(p.x, 0);
        context.lineTo(p.x, viewport.height);
      } else {
        context.moveTo(0, p.y);
        context.lineTo(viewport.width, p.y);
      }
      context.stroke();
    }
    context.setLineDash([]);
  }
  if (overlay.marquee) {
    const a = viewport.toScreen({ x: overlay.marquee.x0, y: overlay.marquee.y1 });
    const b = viewport.toScreen({ x: overlay.marquee.x1, y: overlay.marquee.y0 });
    context.fillStyle = colours.marquee;
    context.strokeStyle = colours.selected;
    context.fillRect(a.x, a.y, b.x - a.x, b.y - a.y);
    context.strokeRect(Math.round(a.x) + 0.5, Math.round(a.y) + 0.5, Math.round(b.x - a.x), Math.round(b.y - a.y));
  }
  if (overlay.frame) {
    const handles = frameHandles(viewport, overlay.frame);
    const [low, high] = [viewport.toScreen({ x: overlay.frame.x0, y: overlay.frame.y0 }), viewport.toScreen({ x: overlay.frame.x1, y: overlay.frame.y1 })];
    context.strokeStyle = colours.frame;
    context.setLineDash([3, 3]);
    context.strokeRect(low.x - 12, high.y - 12, high.x - low.x + 24, low.y - high.y + 24);
    context.setLineDash([]);
    for (const { kind, x, y } of handles) {
      context.beginPath();
      if (kind === "rotate") context.arc(x, y, 4.5, 0, 2 * Math.PI);
      else context.rect(x - 4, y - 4, 8, 8);
      context.fillStyle = colours.paper;
      context.fill();
      context.strokeStyle = colours.selected;
      context.stroke();
    }
  }
  if (overlay.mark) {
    const { x, y } = viewport.toScreen(overlay.mark);
    context.strokeStyle = colours.selected;
    context.lineWidth = 1.6;
    circle(context, { x, y }, overlay.mark.closes ? 10 : 6);
    context.stroke();
  }
}

/** @typedef {import("../core/geometry.js").Point} Point */

/** @param {CanvasRenderingContext2D} context @param {Point} from @param {Point} to */
function strokeLine(context, from, to) {
  context.beginPath();
  context.moveTo(from.x, from.y);
  context.lineTo(to.x, to.y);
  context.stroke();
}

/** Begins a circle, to be filled or stroked. @param {CanvasRenderingContext2D} context @param {Point} centre @param {number} radius */
function circle(context, centre, radius) {
  context.beginPath();
  context.arc(centre.x, centre.y, radius, 0, 2 * Math.PI);
}

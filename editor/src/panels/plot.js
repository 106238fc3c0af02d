// Curvature against arc length, as in the papers' figures, with the joins marked.

import { distance } from "../core/geometry.js";
import { joinInfo } from "../core/joins.js";
import { colourOf } from "../view/colours.js";
import { drawSymbol } from "../view/symbols.js";
import { byId, h, number } from "./dom.js";

/** @typedef {import("../app.js").App} App */

/** Milliseconds between plots while something is dragged. */
const PAUSE = 60;
const MARGIN = { left: 64, right: 20, top: 24, bottom: 24 };

/** @param {App} app */
export function buildPlot(app) {
  const panel = byId("plot");
  const canvas = h("canvas", { role: "img" });
  const title = h("p", { class: "plot-title" });
  panel.append(canvas, title);
  const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d", { desynchronized: true }));
  /** Of the pointer. @type {number | null} */
  let pointerX = null;
  canvas.addEventListener("pointermove", (event) => {
    pointerX = event.offsetX;
    draw();
  });
  canvas.addEventListener("pointerleave", () => {
    pointerX = null;
    app.stage.show({});
    draw();
  });

  function draw() {
    panel.hidden = !app.settings.values.plot;
    if (panel.hidden) return;
    const index = app.editor.selection.contours[0] ?? 0;
    const curve = app.stage.curves[index];
    const [width, height] = [panel.clientWidth, panel.clientHeight];
    const ratio = window.devicePixelRatio || 1;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    const colours = colourOf(app.stage.canvas);
    const segments = curve?.comb.filter((rows) => rows.length) ?? [];
    title.textContent = curve && curve.length > 0 ? `κ against arc length${app.stage.curves.length > 1 ? `, contour ${index + 1}` : ""}` : "κ against arc length: select a contour";
    canvas.setAttribute("aria-label", title.textContent);
    if (segments.length === 0) return;
    const kappas = segments.flatMap((rows) => Array.from({ length: rows.length / 5 }, (_, i) => rows[5 * i + 4]));
    const [lowest, highest] = kappas.reduce(([low, high], k) => [Math.min(low, k), Math.max(high, k)], [0, 0]);
    // A cusp's curvature is cut, so that the rest can be read.
    const limit = 4 * curve.typicalCurvature;
    const low = Math.max(lowest, -limit);
    const high = Math.min(highest, limit);
    const span = high - low || 1;
    const plotWidth = width - MARGIN.left - MARGIN.right;
    const plotHeight = height - MARGIN.top - MARGIN.bottom;
    const toX = (/** @type {number} */ s) => MARGIN.left + (s / curve.length) * plotWidth;
    const toY = (/** @type {number} */ k) => MARGIN.top + ((high - Math.max(low, Math.min(high, k))) / span) * plotHeight;

    context.font = "11px system-ui, sans-serif";
    context.textBaseline = "middle";
    context.lineWidth = 1;
    const labels = [high, 0, low].filter((k, i, all) => all.indexOf(k) === i && (k === 0 || Math.abs(toY(k) - toY(0)) > 14));
    for (const k of labels) {
      const y = Math.round(toY(k)) + 0.5;
      context.strokeStyle = k === 0 ? colours.axis : colours.grid;
      context.beginPath();
      context.moveTo(MARGIN.left, y);
      context.lineTo(width - MARGIN.right, y);
      context.stroke();
      context.fillStyle = colours.faint;
      context.textAlign = "right";
      context.fillText(number(k, 2), MARGIN.left - 8, y);
    }
    const places = curve.knotPlaces;
    context.strokeStyle = colours.gridStrong;
    for (const s of places) {
      const x = Math.round(toX(s)) + 0.5;
      context.beginPath();
      context.moveTo(x, MARGIN.top);
      context.lineTo(x, height - MARGIN.bottom);
      context.stroke();
    }
    context.fillStyle = colours.combTeeth;
    context.strokeStyle = colours.comb;
    context.lineJoin = "round";
    for (const rows of segments) {
      context.beginPath();
      context.moveTo(toX(rows[0]), toY(0));
      for (let i = 0; i < rows.length; i += 5) context.lineTo(toX(rows[i]), toY(rows[i + 4]));
      context.lineTo(toX(rows[rows.length - 5]), toY(0));
      context.globalAlpha = 0.45;
      context.fill();
      context.globalAlpha = 1;
      context.beginPath();
      for (let i = 0; i < rows.length; i += 5) context.lineTo(toX(rows[i]), toY(rows[i + 4]));
      context.lineWidth = 1.6;
      context.stroke();
    }
    // Knots stand on the foot of the plot, the selected ones marked.
    const { knots } = curve;
    places.forEach((s, i) => {
      const knot = knots[i % knots.length];
      if (!knot) return;
      const isEnd = !app.editor.contours[index]?.closed && (i === 0 || i === knots.length - 1);
      const symbol = isEnd ? (i === 0 ? "triangle" : "bar") : joinInfo(knot.join).symbol;
      const selected = app.editor.selection.has(index, i % knots.length);
      drawSymbol(context, symbol, { x: toX(s), y: height - MARGIN.bottom + 11, direction: 0, size: 0.75, ink: selected ? colours.selected : colours.knot, paper: colours.paper });
    });
    if (pointerX !== null) {
      const s = Math.max(0, Math.min(1, (pointerX - MARGIN.left) / plotWidth)) * curve.length;
      const at = curve.at(s);
      if (!at) return;
      context.beginPath();
      context.arc(toX(s), toY(at.curvature), 3.5, 0, 2 * Math.PI);
      context.fillStyle = colours.selected;
      context.fill();
      title.textContent = `s = ${number(s, 4)}   κ = ${number(at.curvature, 4)}   radius ${number(1 / Math.abs(at.curvature), 4)}`;
      // The same place on the drawing.
      const seen = app.stage.overlay.mark;
      if (!seen || distance(seen, at) > 1e-9) app.stage.show({ mark: { x: at.x, y: at.y } });
    }
  }

  // What is dragged comes first: the plot leaves frames out.
  let last = 0;
  app.stage.afterFrame(() => {
    const now = performance.now();
    if (app.editor.isPreviewing && now - last < PAUSE) return;
    last = now;
    draw();
  });
  app.settings.subscribe(() => {
    panel.hidden = !app.settings.values.plot;
    draw();
  });
  new ResizeObserver(draw).observe(panel);
  panel.hidden = !app.settings.values.plot;
}

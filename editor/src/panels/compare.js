// Other splines on the same knots: over one another on the canvas, or side by side with their numbers.

import { choiceOf } from "../core/document.js";
import { union } from "../core/geometry.js";
import { catalogue, countBeziers, splineInfo } from "../curves/curves.js";
import { COMPARE_COLOURS } from "../view/stage.js";
import { Viewport } from "../view/viewport.js";
import { colourOf } from "../view/colours.js";
import { seenAccuracy } from "../view/scene.js";
import { byId, h, number } from "./dom.js";
import { paramControls } from "./params.js";

/** @typedef {import("../app.js").App} App */
/** @typedef {import("../curves/curves.js").Solved} Solved */

/** @param {App} app */
export function buildCompare(app) {
  const { settings, editor } = app;
  const panel = byId("compare");
  const rows = h("tbody");
  const table = h("table", { class: "numbers" },
    h("thead", {}, h("tr", {}, ...["", "length", "bending", "variation", "cubics"].map((name) => h("th", { scope: "col" }, name)))), rows);
  const params = h("div", { class: "params" });
  const picks = h("div", { class: "chips", role: "group", "aria-label": "Splines to compare" },
    ...catalogue.map(({ name, summary }) =>
      h("button", {
        type: "button", class: "chip", "data-spline": name, title: summary,
        onclick() {
          const { compare } = settings.values;
          settings.set({ compare: compare.includes(name) ? compare.filter((other) => other !== name) : [...compare, name] });
        },
      }, name)));
  const side = h("button", { type: "button", class: "small", onclick: () => openSide(app) }, "Side by side");
  const none = h("button", { type: "button", class: "small", onclick: () => settings.set({ compare: [] }) }, "None");
  const close = h("button", { type: "button", class: "close", "aria-label": "Close the comparison", onclick: () => app.openCompare(false) }, "×");
  panel.append(h("header", {}, h("h2", {}, "Compare splines"), close), picks, params, table, h("div", { class: "buttons" }, side, none));

  let shown = "";
  /** Counts under way. @type {(() => void)[]} */
  const counting = [];
  const update = () => {
    if (panel.hidden) return;
    const { compare, compareParams } = settings.values;
    for (const chip of picks.children) {
      const i = compare.indexOf(/** @type {HTMLElement} */ (chip).dataset.spline ?? "");
      chip.setAttribute("aria-pressed", String(i >= 0));
      /** @type {HTMLElement} */ (chip).style.setProperty("--chip", i >= 0 ? COMPARE_COLOURS[i % COMPARE_COLOURS.length] : "");
      chip.classList.toggle("coloured", i >= 0);
    }
    if (shown !== compare.join()) {
      shown = compare.join();
      params.replaceChildren(...compare.flatMap((name) => {
        const specs = splineInfo(name)?.params.filter(({ kind }) => kind === "number") ?? [];
        if (specs.length === 0) return [];
        const controls = paramControls(specs, compareParams[name] ?? {}, (values) =>
          settings.set({ compareParams: { ...settings.values.compareParams, [name]: values } }));
        controls.show(compareParams[name] ?? {});
        return [h("h3", {}, name), ...controls.elements];
      }));
    }
    const all = [{ name: `${editor.state.document.spline}`, colour: "var(--canvas-curve)", curves: app.stage.curves }, ...app.stage.compared];
    for (const stop of counting.splice(0)) stop();
    rows.replaceChildren(...all.map(({ name, colour, curves }, i) => {
      const n = totals(curves);
      const cubics = h("td");
      counting.push(countBeziers(curves, settings.values.accuracy, (n) => (cubics.textContent = n ? String(n.cubics) : "…")));
      return h("tr", {}, h("th", { scope: "row" }, h("span", { class: "swatch", style: `background:${colour}` }), i === 0 ? `${name} (drawing)` : name),
        ...[number(n.length, 5), number(n.bending, 3), number(n.variation, 3)].map((cell) => h("td", {}, cell)), cubics);
    }));
    none.hidden = side.hidden = compare.length === 0;
  };
  let timer = 0;
  editor.subscribe(() => {
    clearTimeout(timer);
    timer = window.setTimeout(update, editor.isPreviewing ? 150 : 0);
  });
  settings.subscribe(update);
  return { panel, update };
}

/** @param {readonly Solved[]} curves */
function totals(curves) {
  const sum = (/** @type {(curve: Solved) => number} */ of) => curves.reduce((total, curve) => total + of(curve), 0);
  return {
    length: sum(({ measures }) => measures.length), bending: sum(({ measures }) => measures.bendingEnergy),
    variation: sum(({ measures }) => measures.variationEnergy),
  };
}

/**
 * The curves alone, in a canvas of their own.
 * @param {App} app
 * @param {readonly Solved[]} curves
 * @param {string} label
 * @param {readonly {x: number, y: number}[]} [knots]
 * @param {boolean} [filled]
 */
export function picture(app, curves, label, knots = [], filled = false) {
  const [width, height] = [320, 240];
  const ratio = window.devicePixelRatio || 1;
  const canvas = h("canvas", { width: width * ratio, height: height * ratio, role: "img", "aria-label": label });
  const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  const viewport = new Viewport();
  [viewport.width, viewport.height] = [width, height];
  const box = curves.reduce((/** @type {import("../core/geometry.js").Box | null} */ box, curve) => union(box, curve.box), null);
  if (!box) return canvas;
  viewport.fit(box, 0.1);
  const colours = colourOf(app.stage.canvas);
  context.setTransform(...viewport.matrix(ratio));
  context.lineWidth = 1.8 / viewport.scale;
  context.lineJoin = "round";
  context.strokeStyle = colours.curve;
  const whole = new Path2D();
  for (const curve of curves) whole.addPath(curve.path2d(seenAccuracy(viewport)));
  context.fillStyle = colours.fill;
  if (filled) context.fill(whole, "evenodd");
  context.stroke(whole);
  context.fillStyle = colours.knot;
  for (const { x, y } of knots) {
    context.beginPath();
    context.arc(x, y, (knots.length > 60 ? 1.4 : 3) / viewport.scale, 0, 2 * Math.PI);
    context.fill();
  }
  return canvas;
}

/** @param {App} app */
function openSide(app) {
  const { document: drawing } = app.editor.state;
  const contours = app.editor.contours;
  const own = contours.map((contour) => app.store.canonical(contour, choiceOf(drawing, contour)));
  const all = [{ name: `${drawing.spline} (drawing)`, curves: own }, ...app.stage.compared];
  const knots = contours.flatMap((contour) => contour.knots);
  const closed = contours.every((contour) => contour.closed);
  const cells = all.map(({ name, curves }) => {
    const n = totals(curves);
    const relaxed = curves.reduce((count, curve) => count + curve.relaxed.length, 0);
    return h("figure", {}, picture(app, curves, `the drawing by ${name}`, knots, closed),
      h("figcaption", {}, h("b", {}, name), ` length ${number(n.length, 5)}, bending ${number(n.bending, 3)}, variation ${number(n.variation, 3)}${relaxed ? `, ${relaxed} relaxed` : ""}`));
  });
  app.dialog("Side by side", "side", h("div", { class: "cells" }, ...cells));
}

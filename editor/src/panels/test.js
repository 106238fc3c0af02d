// The fairness test of thesis 2.1.1 as a mode.

import { EXPONENTS, shuffled, summed } from "../core/fairness_test.js";
import { picture } from "./compare.js";
import { h, number } from "./dom.js";

/** @typedef {import("../app.js").App} App */
/** @typedef {import("../core/fairness_test.js").Answer} Answer */

const STORE = "faircurve.fairness-test";

/** The knots that are asked about at first: a wave with turns of several sizes. */
/** @type {import("../core/document.js").Contour} */
const SAMPLE = { closed: false, knots: [{ x: 0, y: 0 }, { x: 60, y: 120 }, { x: 190, y: 130 }, { x: 240, y: 20 }, { x: 370, y: 10 }, { x: 430, y: 130 }] };

/** @returns {Answer[]} */
function answers() {
  try {
    const kept = JSON.parse(localStorage.getItem(STORE) ?? "[]");
    return Array.isArray(kept) ? kept.filter((answer) => typeof answer?.alpha === "number") : [];
  } catch {
    return [];
  }
}

/** @param {App} app */
export function openTest(app) {
  const own = app.editor.contours.filter(({ knots }) => knots.length >= 3);
  // Joins other than corners are adapted; every knot is smooth, as in the study.
  const plain = (/** @type {readonly import("../core/document.js").Contour[]} */ contours) =>
    contours.map(({ closed, knots }) => ({ closed, knots: knots.map(({ x, y, join }) => (join === "corner" ? { x, y, join } : { x, y })) }));
  let contours = plain([SAMPLE]);
  const curvesFor = (/** @type {number} */ alpha) => contours.map((contour) => app.store.canonical(contour, { spline: "log-aesthetic", params: { alpha } }));
  const body = h("div");
  const element = app.dialog("Which is the fairest?", "test", body);
  ask();

  function ask() {
    const choices = shuffled().map((alpha, i) =>
      h("button", {
        type: "button", class: "variant", "aria-label": `variant ${i + 1}`,
        onclick() {
          localStorage.setItem(STORE, JSON.stringify([...answers(), { alpha, at: new Date().toISOString() }]));
          tell(alpha);
        },
      }, picture(app, curvesFor(alpha), `variant ${i + 1}`, contours.flatMap(({ knots }) => knots))));
    const mine = h("button", {
      type: "button", class: "small", hidden: own.length === 0,
      onclick() {
        contours = plain(own);
        ask();
      },
    }, "On the drawing's knots");
    body.replaceChildren(h("p", {}, "All pass through the same knots. Pick the one that looks smoothest to you; there is no right answer."),
      h("div", { class: "cells" }, ...choices), h("div", { class: "buttons" }, mine, h("button", { type: "button", class: "small", onclick: () => tell(null) }, "Show the answers so far")));
  }

  /** @param {number | null} picked */
  function tell(picked) {
    const energies = EXPONENTS.map((alpha) => curvesFor(alpha).reduce((sum, curve) => sum + curve.measures.bendingEnergy, 0));
    const { count, mean } = summed(answers());
    const words = [
      picked === null ? "" : `You picked α = ${picked}.`,
      count ? `${count === 1 ? "One answer" : `${count} answers`} in this browser, mean α = ${number(mean, 3)}.` : "No answers yet.",
      "In the thesis's study the mean was 1.78; bending energy is least near 0.9, so energy alone is not what we see as fair.",
    ].join(" ");
    const clear = h("button", {
      type: "button", class: "small",
      onclick() {
        localStorage.removeItem(STORE);
        tell(null);
      },
    }, "Forget the answers");
    body.replaceChildren(h("p", {}, words), chart(energies), h("p", { class: "note" }, "Bars: how often each exponent was picked. Line: bending energy on these knots, in parts of the least."),
      h("div", { class: "buttons" }, h("button", { type: "button", class: "small", onclick: ask }, "Once more"), clear, h("button", { type: "button", class: "small", onclick: () => element.close() }, "Done")));
  }
}

/** Figure 2.2: votes as bars, energy as a line. @param {number[]} energies */
function chart(energies) {
  const [width, height, left, bottom, top] = [640, 260, 56, 34, 16];
  const { votes } = summed(answers());
  const most = Math.max(1, ...votes.map(({ count }) => count));
  const least = Math.min(...energies);
  const largest = Math.max(...energies.map((energy) => energy / least), 1.05);
  const step = (width - 2 * left) / votes.length;
  const x = (/** @type {number} */ i) => left + (i + 0.5) * step;
  const base = height - bottom;
  const bars = votes.map(({ alpha, count }, i) => {
    const tall = ((base - top) * count) / most;
    return `<rect class="bar" x="${x(i) - step * 0.3}" y="${base - tall}" width="${step * 0.6}" height="${tall}"/>
      <text x="${x(i)}" y="${base + 16}">${alpha}</text>${count ? `<text x="${x(i)}" y="${base - tall - 4}">${count}</text>` : ""}`;
  });
  const points = energies.map((energy, i) => `${x(i)},${base - ((base - top) * 0.9 * (energy / least - 1)) / (largest - 1)}`);
  const label = `votes: ${votes.map(({ alpha, count }) => `α ${alpha}: ${count}`).join(", ")}`;
  return h("div", {
    class: "chart",
    html: `<svg viewBox="0 0 ${width} ${height}" role="img" aria-label="${label}"><line class="base" x1="${left}" x2="${width - left}" y1="${base}" y2="${base}"/>${bars.join("")}
      <polyline class="energy" points="${points.join(" ")}"/>${points.map((p) => `<circle class="dot" cx="${p.split(",")[0]}" cy="${p.split(",")[1]}" r="3"/>`).join("")}
      <text class="end" x="${width - left + 4}" y="${Number(points[points.length - 1].split(",")[1]) + 4}">×${number(energies[energies.length - 1] / least, 4)}</text><text x="${width / 2}" y="${height - 2}">exponent α</text></svg>`,
  });
}

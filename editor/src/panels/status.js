// The line below the drawing: what was just said, or else what is wrong with the curve, or how the tool works.

import { byId } from "./dom.js";

/** Milliseconds for which something said stands. */
const STANDS = 6000;

/** @param {import("../app.js").App} app @returns {(message: string) => void} says something */
export function buildStatus(app) {
  const [line, hint, zoom] = [byId("said"), byId("hint"), byId("zoom")];
  let timer = 0;
  const update = () => {
    const relaxed = app.stage.curves.flatMap((curve, contour) => curve.relaxed.map((r) => ({ ...r, contour })));
    const [first] = relaxed;
    hint.classList.toggle("relaxed", first !== undefined);
    hint.textContent = first ? relaxedWords(first, relaxed.length) : app.tool.hint;
    zoom.textContent = `${Math.round(app.stage.viewport.scale * 100)} %`;
  };
  app.stage.afterFrame(update);
  app.onTool(update);
  return (message) => {
    line.textContent = message;
    clearTimeout(timer);
    timer = window.setTimeout(() => (line.textContent = ""), STANDS);
  };
}

/**
 * What couldn't be met, and what to try.
 * @param {import("../curves/curves.js").Place & {contour: number}} relaxed
 * @param {number} count
 */
function relaxedWords({ contour, knot, segment, asked, got, reason }, count) {
  const place = knot !== undefined ? `knot ${knot + 1}` : `segment ${(segment ?? 0) + 1}`;
  const more = count > 1 ? `, and ${count - 1} more` : "";
  return `Dashed: contour ${contour + 1}, ${place} asked ${asked}, got ${got}: ${reason ?? ""}${more}. Try moving the knot, or a weaker join there.`;
}

// Colours of the canvas: the style sheet's, so that a theme stands in one place.

const NAMES = [
  "paper", "grid", "gridStrong", "axis", "fill", "curve", "relaxed", "comb", "combTeeth", "bezier", "bezierArm", "extremum",
  "handle", "knot", "selected", "selectedHalo", "snap", "marquee", "frame", "ink", "faint",
];

/** @param {Element} element @returns {Record<string, string>} */
export function colourOf(element) {
  const style = getComputedStyle(element);
  return Object.fromEntries(NAMES.map((name) => [name, style.getPropertyValue(`--canvas-${name}`).trim() || "gray"]));
}

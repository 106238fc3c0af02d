// Controls for a spline's parameters, as the catalogue describes them.

import { rounded } from "../core/geometry.js";
import { h } from "./dom.js";

/** @typedef {Record<string, number | string>} Values */
/** Sliders end here where a parameter may be anything. */
const REACH = 10;

/**
 * @param {readonly import("faircurve").ParamSpec[]} specs
 * @param {Readonly<Values>} initial
 * @param {(values: Values, moving: boolean) => void} set with those that aren't defaults
 */
export function paramControls(specs, initial, set) {
  /** @type {Values} */
  let values = { ...initial };
  const take = (/** @type {string} */ name, /** @type {number | string} */ value, /** @type {boolean} */ moving) => {
    values = { ...values, [name]: value };
    const spec = specs.find((spec) => spec.name === name);
    if (value === spec?.default) delete values[name];
    set({ ...values }, moving);
  };
  const controls = specs.map((spec) => control(spec, (value, moving) => take(spec.name, value, moving)));
  return {
    elements: controls.map(({ element }) => element),
    /** @param {Readonly<Values>} now */
    show(now) {
      values = { ...now };
      specs.forEach((spec, i) => controls[i].show(now[spec.name] ?? spec.default));
    },
  };
}

/** @param {import("faircurve").ParamSpec} spec @param {(value: number | string, moving: boolean) => void} take */
function control(spec, take) {
  const label = h("span", { title: spec.summary }, spec.name);
  if (spec.kind === "choice") {
    const select = h("select", { "aria-label": spec.summary, onchange: () => take(select.value, false) },
      ...spec.options.map((option) => h("option", { value: option }, option)));
    return {
      element: h("label", { class: "field wide", title: spec.summary }, label, select),
      show(/** @type {number | string} */ value) { select.value = String(value); },
    };
  }
  if (spec.kind === "text") {
    const input = h("input", { type: "text", "aria-label": spec.summary, onchange: () => take(input.value, false) });
    return {
      element: h("label", { class: "field wide", title: spec.summary }, label, input),
      show(/** @type {number | string} */ value) { if (document.activeElement !== input) input.value = String(value); },
    };
  }
  const [min, max] = [Math.max(spec.min, -REACH), Math.min(spec.max, REACH)];
  const output = h("output", {});
  const slider = h("input", {
    type: "range", min, max, step: (max - min) / 200, "aria-label": spec.summary,
    oninput() {
      output.textContent = String(rounded(Number(slider.value), 2));
      take(rounded(Number(slider.value), 4), true);
    },
    onchange: () => take(rounded(Number(slider.value), 4), false),
  });
  return {
    element: h("label", { class: "field wide", title: spec.summary }, label, slider, output),
    show(/** @type {number | string} */ value) {
      slider.value = String(value);
      output.textContent = String(rounded(Number(value), 2));
    },
  };
}

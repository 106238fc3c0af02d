// The panel on the right: what is selected, in numbers, and how the drawing is solved and shown.

import { EDGES, knotAt, selectedKnots } from "../core/commands.js";
import { boxOf, rounded, scaling, translation } from "../core/geometry.js";
import { JOINS, joinInfo } from "../core/joins.js";
import { SOURCES } from "../core/snap.js";
import { LAYERS } from "../view/layers.js";
import { symbolPicture } from "../view/symbols.js";
import { actionOf } from "../actions.js";
import { catalogue, countBeziers, splineInfo } from "../curves/curves.js";
import { byId, h, number } from "./dom.js";
import { paramControls } from "./params.js";

/** @typedef {import("../app.js").App} App */

/** Milliseconds between updates of what takes time to measure, while something is dragged. */
const PAUSE = 150;
/** Knots of a glyph that isn't measured while something is dragged. */
const LARGE = 80;

/** @param {App} app */
export function buildInspector(app) {
  const parts = [drawingPart(app), knotPart(app), severalPart(app), contourPart(app), showPart(app)];
  byId("inspector").append(...parts.map(({ element }) => element));
  let last = 0;
  let timer = 0;
  const slowly = () => {
    timer = 0;
    last = performance.now();
    for (const part of parts) part.update(true);
  };
  const update = () => {
    clearTimeout(timer);
    if (!app.editor.isPreviewing || performance.now() - last > PAUSE) return slowly();
    for (const part of parts) part.update(false);
    timer = window.setTimeout(slowly, PAUSE);
  };
  app.editor.subscribe(update);
  app.settings.subscribe(update);
  update();
}

/**
 * A titled part.
 * @param {string} title
 * @param {...(Node | string)} children
 */
const part = (title, ...children) => h("section", { class: "part", "aria-label": title }, h("h2", {}, title), ...children);

/**
 * A field with a label; its value is taken when it changes, and emptied it is cleared, where that means something.
 * @param {string} label
 * @param {Record<string, any>} attributes
 * @param {(value: number) => void} take
 * @param {{clear?: () => void, step?: number}} [options] `step`: what an arrow key adds
 */
function field(label, attributes, take, { clear, step = 1 } = {}) {
  const input = h("input", {
    type: "text", inputmode: "decimal", "aria-label": attributes["aria-label"] ?? label, ...attributes,
    onchange() {
      const value = evaluated(input.value);
      if (value !== null) take(value);
      else if (clear && input.value.trim() === "") clear();
      else input.dispatchEvent(new Event("blur"));
    },
    onkeydown(/** @type {KeyboardEvent} */ event) {
      const by = { ArrowUp: 1, ArrowDown: -1 }[event.key];
      const value = evaluated(input.value);
      if (by && value !== null) {
        event.preventDefault();
        input.value = String(rounded(value + by * step * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1), 6));
        take(Number(input.value));
      }
      if (event.key === "Enter") input.select();
    },
  });
  return { element: h("label", { class: "field" }, h("span", {}, label), input), input };
}

/** A number, or a sum such as `120+8`. @param {string} text @returns {number | null} */
export function evaluated(text) {
  const terms = text.replace(",", ".").replace(/−/g, "-").match(/^\s*([+-]?\s*\d*\.?\d+)(\s*[+-]\s*\d*\.?\d+)*\s*$/);
  if (!terms) return null;
  return text.replace(",", ".").replace(/−/g, "-").match(/[+-]?\s*\d*\.?\d+/g)?.reduce((sum, term) => sum + Number(term.replace(/\s/g, "")), 0) ?? null;
}

/** Shows a value, unless the user has typed another that isn't taken yet. @param {HTMLInputElement} input @param {string} value */
function show(input, value) {
  if (document.activeElement !== input || input.dataset.shown === input.value) input.value = value;
  input.dataset.shown = value;
}

/** @param {App} app */
function drawingPart(app) {
  const { editor } = app;
  const glyphs = h("select", { "aria-label": "Glyph", onchange: () => app.showGlyph(Number(glyphs.value)) });
  const glyphField = h("label", { class: "field wide" }, h("span", {}, "Glyph"), glyphs);
  const splines = splineSelect("Spline", (name) => editor.run("setSpline", { spline: name }));
  const summary = h("p", { class: "note" });
  const params = h("div", { class: "params" });
  const element = part("Drawing", glyphField, h("label", { class: "field wide" }, h("span", {}, "Spline"), splines), summary, params);
  let shownGlyphs = /** @type {unknown} */ (null);
  let shownSpline = "";
  let controls = paramControls([], {}, () => {});
  return {
    element,
    update() {
      const { document: drawing, glyph } = editor.state;
      const names = drawing.glyphs.map((g) => [g.name, g.layer && g.layer !== "Fore" ? `(${g.layer})` : ""].join(" ").trim() || "unnamed");
      if (shownGlyphs !== names.join()) {
        shownGlyphs = names.join();
        glyphs.replaceChildren(...names.map((name, i) => h("option", { value: i }, name)));
      }
      glyphs.value = String(glyph);
      glyphField.hidden = drawing.glyphs.length < 2;
      splines.value = drawing.spline;
      if (shownSpline !== drawing.spline) {
        shownSpline = drawing.spline;
        const info = splineInfo(drawing.spline);
        summary.textContent = info?.summary ?? "";
        const set = (/** @type {Record<string, number | string>} */ values, /** @type {boolean} */ moving) =>
          moving
            ? editor.preview([["setSpline", { spline: drawing.spline, params: values }]])
            : editor.run("setSpline", { spline: editor.committed.document.spline, params: values });
        controls = paramControls(info?.params ?? [], drawing.params, set);
        params.replaceChildren(...controls.elements);
      }
      controls.show(drawing.params);
    },
  };
}

/** @param {string} label @param {(name: string) => void} choose @param {string} [none] */
function splineSelect(label, choose, none) {
  const select = h("select", { "aria-label": label, onchange: () => choose(select.value) });
  if (none) select.append(h("option", { value: "" }, none));
  select.append(...catalogue.map(({ name }) => h("option", { value: name }, name)));
  return select;
}

/** @param {App} app */
function joinButtons(app) {
  const buttons = JOINS.map((info) => {
    const button = h("button", {
      type: "button", class: "join", title: `${info.words}: ${info.meaning} (${info.key})`, "aria-label": info.words, "aria-pressed": "false",
      html: symbolPicture(info.symbol), onclick: () => actionOf(`join-${info.join}`).run(app),
    });
    return { info, button };
  });
  const words = h("p", { class: "join-words", "aria-live": "polite" });
  return {
    elements: [h("div", { class: "joins", role: "group", "aria-label": "Join" }, ...buttons.map(({ button }) => button)), words],
    /** @param {readonly string[]} joins those of the selected knots @param {readonly string[]} known those of the spline @param {string} said */
    show(joins, known, said) {
      for (const { info, button } of buttons) {
        button.setAttribute("aria-pressed", String(joins.length > 0 && joins.every((join) => join === info.join)));
        button.classList.toggle("foreign", !known.includes(info.join));
      }
      words.textContent = said;
    },
  };
}

/** @param {App} app */
function knotPart(app) {
  const { editor } = app;
  const set = (/** @type {Partial<import("../core/document.js").Knot>} */ fields) => editor.run("setKnot", { fields });
  const x = field("x", {}, (value) => set({ x: value }));
  const y = field("y", {}, (value) => set({ y: value }));
  const joins = joinButtons(app);
  const unit = (/** @type {number} */ degrees) => {
    const angle = (degrees * Math.PI) / 180;
    return /** @type {[number, number]} */ ([rounded(Math.cos(angle), 6), rounded(Math.sin(angle), 6)]);
  };
  const angles = /** @type {const} */ (["tangent_in", "tangent_out"]).map((side) => {
    const words = side === "tangent_in" ? "arrives at" : "leaves at";
    const made = field(words, { "aria-label": `${words}, in degrees` }, (value) => set({ [side]: unit(value) }));
    made.element.classList.add("wide");
    return { side, ...made };
  });
  const numbers = NUMBERS.map((info) => {
    const made = field(info.label, { "aria-label": info.words }, (value) => set({ [info.name]: value }), {
      clear: () => set({ [info.name]: undefined }), step: info.step,
    });
    made.element.classList.add("wide");
    return { info, ...made };
  });
  const free = h("button", { type: "button", class: "small", onclick: () => actionOf("free-tangent").run(app) }, "Free the tangent");
  const give = h("button", { type: "button", class: "small", onclick: () => actionOf("tangent").run(app) }, "Give the tangent");
  const rows = h("tbody");
  const table = h("table", { class: "numbers" }, h("caption", {}, "Continuity here"),
    h("thead", {}, h("tr", {}, h("th", { scope: "col" }, ""), h("th", { scope: "col" }, "before"), h("th", { scope: "col" }, "after"), h("th", { scope: "col" }, "jump"))), rows);
  const why = h("p", { class: "why", role: "status" });
  const element = part("Knot", h("div", { class: "pair" }, x.element, y.element), ...joins.elements,
    ...angles.map(({ element }) => element), ...numbers.map(({ element }) => element),
    h("div", { class: "buttons" }, give, free), why, table);
  return {
    element,
    /** @param {boolean} all */
    update(all) {
      const place = editor.selection.only;
      const knot = place && knotAt(editor.state, place);
      element.hidden = !knot;
      if (!place || !knot) return;
      const curve = app.stage.curves[place.contour];
      const solved = curve.knots[place.knot];
      show(x.input, String(rounded(knot.x)));
      show(y.input, String(rounded(knot.y)));
      if (!all || !solved) return;
      const { closed, knots } = editor.contours[place.contour];
      const isEnd = !closed && (place.knot === 0 || place.knot === knots.length - 1);
      const info = joinInfo(solved.join);
      const own = knot.join === undefined && !isEnd ? `, ${curve.spline}'s own` : "";
      joins.show(isEnd ? [] : [solved.join], splineInfo(curve.spline)?.joins ?? [], isEnd ? "an end of an open contour" : `${info.words}${own}`);
      for (const { side, input } of angles) {
        const given = knot[side];
        const has = side === "tangent_in" ? solved.direction_in : solved.direction_out;
        show(input, given ? String(rounded((Math.atan2(given[1], given[0]) * 180) / Math.PI, 2)) : "");
        input.placeholder = has === null ? "–" : `${rounded((has * 180) / Math.PI, 2)}° (free)`;
        input.disabled = has === null;
      }
      for (const { info, element, input } of numbers) {
        const given = knot[info.name];
        // What the spline has no use for is shown where it is given, so that it can be taken away.
        element.hidden = given === undefined && !info.isFor(curve.spline, isEnd);
        const has = info.has(solved);
        show(input, given === undefined ? "" : String(rounded(given, 9)));
        input.placeholder = has === null ? "–" : typeof has === "number" ? `${number(has, 4)} (free)` : has;
        input.disabled = has === null;
      }
      const isGiven = knot.tangent_in !== undefined || knot.tangent_out !== undefined || knot.curvature_in !== undefined || knot.curvature_out !== undefined;
      free.hidden = !isGiven;
      give.hidden = isGiven;
      const isHere = (/** @type {{knot?: number}} */ { knot }) => knot === place.knot;
      const said = curve.relaxed.filter(isHere).map(({ asked, got, reason }) => `asked ${asked}, got ${got}: ${reason}`);
      // Joins that are adapted show as what they are; what is given and has no use would be a riddle.
      const unused = curve.adapted.filter((a) => isHere(a) && !JOINS.some(({ join }) => join === a.asked));
      said.push(...unused.map(({ asked, got }) => `${curve.spline} takes no ${asked} here: ${got}`));
      why.textContent = said.join(". ");
      why.hidden = said.length === 0;
      const jump = curve.jumps[place.knot];
      table.hidden = !jump;
      if (!jump) return;
      const degrees = (/** @type {number | null} */ angle) => (angle === null ? "–" : `${number(rounded((angle * 180) / Math.PI, 3), 5)}°`);
      const row = (/** @type {string} */ name, /** @type {string[]} */ ...cells) =>
        h("tr", {}, h("th", { scope: "row" }, name), ...cells.map((cell) => h("td", {}, cell)));
      const { size } = jump;
      rows.replaceChildren(
        row("direction", degrees(solved.direction_in), degrees(solved.direction_out), jumpWords(jump.direction)),
        row("κ", number(solved.curvature_in, 4), number(solved.curvature_out, 4), jumpWords(jump.curvature * size)),
        row("κ′", "", "", jumpWords(jump.firstDerivative * size ** 2)),
        row("κ″", "", "", jumpWords(jump.secondDerivative * size ** 3)),
      );
    },
  };
}

/**
 * What else a knot may be given: the fields of the document, which splines have them, and what they are where they are free.
 * @type {{name: "curvature_in" | "curvature_out" | "tension_in" | "tension_out" | "curl", label: string, words: string, step: number,
 *   isFor: (spline: string, isEnd: boolean) => boolean, has: (solved: import("faircurve").SolvedKnot) => number | string | null}[]}
 */
const NUMBERS = [
  { name: "curvature_in", label: "κ before", words: "curvature before, in 1/units", step: 0.001, isFor: (spline) => CURVED.has(spline), has: (solved) => solved.curvature_in },
  { name: "curvature_out", label: "κ after", words: "curvature after, in 1/units", step: 0.001, isFor: (spline) => CURVED.has(spline), has: (solved) => solved.curvature_out },
  { name: "tension_in", label: "tension before", words: "tension before, at least 0.75", step: 0.1, isFor: (spline) => spline === "hobby", has: ({ direction_in }) => (direction_in === null ? null : "the spline's") },
  { name: "tension_out", label: "tension after", words: "tension after, at least 0.75", step: 0.1, isFor: (spline) => spline === "hobby", has: ({ direction_out }) => (direction_out === null ? null : "the spline's") },
  { name: "curl", label: "curl", words: "curl at this end, at least 0", step: 0.1, isFor: (spline, isEnd) => spline === "hobby" && isEnd, has: () => "the spline's" },
];

/** Splines at whose knots a curvature may be given. */
const CURVED = new Set(["spiro", "mvc", "euler", "log-aesthetic", "generated", "mec", "simec", "kurgla1", "bespoke"]);

/** A jump without unit: what rounding leaves counts as none. @param {number} jump */
const jumpWords = (jump) => (Math.abs(jump) < 1e-7 ? "none" : number(jump, 3));

/** @param {App} app */
function severalPart(app) {
  const { editor } = app;
  const box = () => boxOf(selectedKnots(editor.state));
  /** @param {"x0" | "y0"} side @param {number} value */
  const moveTo = (side, value) => {
    const now = box();
    if (now) editor.run("transform", { map: side === "x0" ? translation(value - now.x0, 0) : translation(0, value - now.y0) });
  };
  /** @param {"x" | "y"} axis @param {number} value */
  const resize = (axis, value) => {
    const now = box();
    if (!now) return;
    const size = axis === "x" ? now.x1 - now.x0 : now.y1 - now.y0;
    const factor = value / size;
    if (size > 0 && value > 0) editor.run("transform", { map: scaling({ x: now.x0, y: now.y0 }, axis === "x" ? factor : 1, axis === "y" ? factor : 1) });
  };
  const fields = [
    field("left", {}, (value) => moveTo("x0", value)), field("bottom", {}, (value) => moveTo("y0", value)),
    field("width", {}, (value) => resize("x", value)), field("height", {}, (value) => resize("y", value)),
  ];
  const joins = joinButtons(app);
  const icons = { left: "M4 4v16M8 8h12M8 16h7", centre: "M12 3v18M6 8h12M8 16h8", right: "M20 4v16M4 8h12M9 16h7", top: "M4 4h16M8 8v12M16 8v7", middle: "M3 12h18M8 6v12M16 8v8", bottom: "M4 20h16M8 4v12M16 9v7" };
  const align = /** @type {(keyof typeof EDGES)[]} */ (["left", "centre", "right", "top", "middle", "bottom"]).map((edge) =>
    h("button", {
      type: "button", class: "join", title: `Align ${edge}`, "aria-label": `Align ${edge}`, onclick: () => editor.run("align", { edge }),
      html: `<svg viewBox="0 0 24 24" width="16" height="16" fill="none" stroke="currentColor" stroke-width="2" aria-hidden="true"><path d="${icons[edge]}"/></svg>`,
    }));
  const count = h("p", { class: "note" });
  const element = part("Selection", count, h("div", { class: "pair" }, ...fields.map(({ element }) => element)), ...joins.elements,
    h("div", { class: "joins", role: "group", "aria-label": "Align" }, ...align));
  return {
    element,
    /** @param {boolean} all */
    update(all) {
      const { selection } = editor;
      element.hidden = selection.count < 2;
      const now = element.hidden ? null : box();
      if (!now || !all) return;
      count.textContent = `${selection.count} knots in ${selection.contours.length === 1 ? "one contour" : `${selection.contours.length} contours`}`;
      [now.x0, now.y0, now.x1 - now.x0, now.y1 - now.y0].forEach((value, i) => show(fields[i].input, String(rounded(value))));
      const curves = app.stage.curves;
      const all_joins = selection.places.map(({ contour, knot }) => curves[contour].knots[knot]?.join ?? "");
      const same = all_joins.every((join) => join === all_joins[0]);
      joins.show(all_joins, splineInfo(curves[selection.contours[0]].spline)?.joins ?? [], same ? joinInfo(/** @type {any} */ (all_joins[0])).words : "different joins");
    },
  };
}

/** @param {App} app */
function contourPart(app) {
  const { editor, settings } = app;
  const splines = splineSelect("Spline of this contour", (name) => editor.run("setContourSpline", { spline: name || undefined }), "the drawing's");
  const closed = h("input", { type: "checkbox", onchange: () => actionOf("close").run(app) });
  const rows = h("tbody");
  const heading = h("caption", {}, "");
  const params = h("div", { class: "params" });
  const own = h("div", { class: "params" }, h("label", { class: "field wide" }, h("span", {}, "Spline"), splines), params, h("label", { class: "tick" }, closed, "closed"));
  let shownSpline = "";
  let controls = paramControls([], {}, () => {});
  const table = h("table", { class: "numbers" }, heading, rows);
  const element = part("Contour", own, table);
  const title = /** @type {HTMLElement} */ (element.querySelector("h2"));
  let stopCounting = () => {};
  return {
    element,
    /** @param {boolean} all */
    update(all) {
      // Measuring many knots would hold up the hand; letting go measures them.
      const isLarge = editor.contours.reduce((n, { knots }) => n + knots.length, 0) > LARGE;
      if (!all || (editor.isPreviewing && isLarge)) return;
      const { selection } = editor;
      const curves = app.stage.curves;
      const [only] = selection.contours.length === 1 ? selection.contours : [undefined];
      own.hidden = only === undefined;
      title.textContent = only === undefined ? "All contours" : curves.length > 1 ? `Contour ${only + 1} of ${curves.length}` : "Contour";
      element.hidden = curves.length === 0;
      if (only !== undefined) {
        const contour = editor.contours[only];
        splines.value = contour.spline ?? "";
        closed.checked = contour.closed;
        const spline = contour.spline ?? "";
        if (shownSpline !== spline) {
          shownSpline = spline;
          controls = paramControls(splineInfo(spline)?.params ?? [], contour.params ?? {}, (values, moving) => {
            /** @type {["setContourSpline", object]} */
            const command = ["setContourSpline", { spline, params: values }];
            if (moving) editor.preview([command]);
            else editor.run(...command);
          });
          params.replaceChildren(...controls.elements);
        }
        controls.show(contour.params ?? {});
      }
      const measured = only === undefined ? curves : [curves[only]];
      const sum = (/** @type {(m: typeof curves[0]["measures"]) => number} */ of) => measured.reduce((total, curve) => total + of(curve.measures), 0);
      const row = (/** @type {string} */ name, /** @type {string} */ value, /** @type {string} */ hint) =>
        h("tr", { title: hint }, h("th", { scope: "row" }, name), h("td", {}, value));
      const cubics = row("cubics", "", `Béziers that are written, within ${settings.values.accuracy} units`);
      stopCounting();
      stopCounting = countBeziers(measured, settings.values.accuracy, (n) => {
        /** @type {HTMLElement} */ (cubics.lastElementChild).textContent = n ? `${n.cubics}${n.lines ? ` + ${n.lines} lines` : ""}` : "…";
      });
      const knots = only === undefined ? editor.contours.reduce((n, c) => n + c.knots.length, 0) : editor.contours[only].knots.length;
      rows.replaceChildren(
        row("knots", String(knots), "given points"),
        cubics,
        row("length", number(sum((m) => m.length), 5), "arc length in units"),
        row("bending", number(sum((m) => m.bendingEnergy), 4), "∫κ² ds, in 1/units"),
        row("variation", number(sum((m) => m.variationEnergy), 4), "∫κ′² ds, in 1/units³"),
        row("extrema", String(sum((m) => m.extrema)), "places where |κ| is largest or least within segments"),
        row("inflections", String(sum((m) => m.inflections)), "places where curvature changes its sign"),
      );
    },
  };
}

/** @param {App} app */
function showPart(app) {
  const { settings } = app;
  const toggle = (/** @type {string} */ label, /** @type {string} */ key, /** @type {() => boolean} */ isOn, /** @type {() => void} */ flip) => {
    const button = h("button", { type: "button", class: "chip", title: key ? `${label} (${key})` : label, onclick: flip }, label);
    return { button, update: () => button.setAttribute("aria-pressed", String(isOn())) };
  };
  const layers = LAYERS.flatMap(({ id, label, key }) =>
    label ? [toggle(label, key?.toUpperCase() ?? "", () => settings.values.layers[id], () => actionOf(`layer-${id}`).run(app))] : []);
  layers.push(toggle("Plot of κ", "U", () => settings.values.plot, () => actionOf("plot").run(app)));
  const snaps = [...SOURCES.map(({ id, label }) => ({ id, label })), { id: "grid", label: "Grid" }].map(({ id, label }) =>
    toggle(label, "", () => settings.values.snap[id], () => settings.set({ snap: { ...settings.values.snap, [id]: !settings.values.snap[id] } })));
  const comb = h("input", { type: "range", min: 10, max: 200, "aria-label": "Length of the comb", oninput: () => settings.set({ comb: Number(comb.value) }) });
  const combField = h("label", { class: "field wide" }, h("span", {}, "Comb"), comb);
  const accuracy = field("Accuracy", { "aria-label": "Accuracy of Béziers in units" }, (value) => value > 0 && settings.set({ accuracy: value }));
  const grid = field("Grid", { "aria-label": "Grid in units" }, (value) => value > 0 && settings.set({ grid: value }));
  const opacity = h("input", {
    type: "range", min: 0, max: 100, "aria-label": "Opacity of the picture",
    oninput() {
      app.stage.background.opacity = Number(opacity.value) / 100;
      app.stage.invalidate();
    },
    onchange: () => app.keeping.keepPicture(),
  });
  const lock = h("input", {
    type: "checkbox",
    onchange() {
      app.stage.background.locked = lock.checked;
      app.keeping.keepPicture();
    },
  });
  const height = field("Height", { "aria-label": "Height of the picture in units" }, (value) => {
    app.stage.background.height = value;
    app.stage.invalidate();
    app.keeping.keepPicture();
  });
  const remove = h("button", { type: "button", class: "small", onclick: () => app.keeping.removePicture() }, "Remove");
  const picture = h("div", {}, h("h3", {}, "Picture"), h("label", { class: "field wide" }, h("span", {}, "Opacity"), opacity),
    h("div", { class: "pair" }, height.element, h("label", { class: "tick" }, lock, "locked")), h("div", { class: "buttons" }, remove));
  const element = part("Show", h("div", { class: "chips", role: "group", "aria-label": "Layers" }, ...layers.map(({ button }) => button)), combField,
    h("div", { class: "pair" }, accuracy.element, grid.element),
    h("h3", {}, "Snap to"), h("div", { class: "chips", role: "group", "aria-label": "Snap to" }, ...snaps.map(({ button }) => button)), picture);
  return {
    element,
    update() {
      for (const { update } of [...layers, ...snaps]) update();
      const { values } = settings;
      combField.hidden = !values.layers.comb;
      comb.value = String(values.comb);
      show(accuracy.input, String(values.accuracy));
      show(grid.input, String(values.grid));
      const { background } = app.stage;
      picture.hidden = background.image === null;
      opacity.value = String(Math.round(background.opacity * 100));
      lock.checked = background.locked;
      show(height.input, String(rounded(background.height, 1)));
    },
  };
}

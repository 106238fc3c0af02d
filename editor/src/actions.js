// Everything that the user can do by a menu, a button or a key: one table, from which menus, keys and the list of
// keys are made.

import { COMMANDS, contoursOf, knotAt, selectedContours, selectedKnots } from "./core/commands.js";
import { boxOf, centreOf, rotation, rounded, scaling } from "./core/geometry.js";
import { JOINS } from "./core/joins.js";
import { Selection } from "./core/selection.js";
import { LAYERS } from "./view/layers.js";
import { TOOLS } from "./tools/tools.js";
import { meeting, placing } from "./tools/draw.js";

/** @typedef {import("./app.js").App} App */
/** @typedef {"File" | "Edit" | "Knot" | "Shape" | "View" | "Tool" | "Help"} Group */
/**
 * @typedef {object} Action
 * @property {string} id
 * @property {Group} group
 * @property {string | ((app: App) => string)} label
 * @property {string[]} [keys] such as `Mod+Z`; Mod is Ctrl, ⌘ on Apple's keyboards
 * @property {(app: App) => boolean} [enabled]
 * @property {(app: App) => boolean} [checked] for what is on or off
 * @property {(app: App) => void} run
 * @property {boolean} [hidden] not in menus
 * @property {boolean} [divided] a line above it in its menu
 */

/** @param {App} app */
const hasSelection = ({ editor }) => editor.selection.count > 0;
/** @param {App} app */
const hasSeveral = ({ editor }) => editor.selection.count > 1;
/** @param {App} app */
const selectedIsClosed = ({ editor }) => {
  const only = editor.selection.only;
  return only !== null && editor.contours[only.contour].closed;
};

/** @param {App} app */
const centre = ({ editor }) => {
  const box = boxOf(selectedKnots(editor.state));
  return box ? centreOf(box) : { x: 0, y: 0 };
};

/** @param {number} dx @param {number} dy @returns {(app: App) => void} */
const nudge = (dx, dy) => (app) => {
  // With the pen the arrows move the point that Enter puts a knot at.
  if (app.tool.id === "draw") app.keyboardPen.move(dx, dy);
  else if (hasSelection(app)) app.editor.run("move", { dx, dy }, `nudge ${app.editor.selection.places.length}`);
};

const ARROWS = /** @type {const} */ ([["ArrowLeft", -1, 0], ["ArrowRight", 1, 0], ["ArrowUp", 0, 1], ["ArrowDown", 0, -1]]);
const STEPS = /** @type {const} */ ([["", 1], ["Shift+", 10], ["Alt+", 0.1]]);
const WORDS = { ArrowLeft: "left", ArrowRight: "right", ArrowUp: "up", ArrowDown: "down" };

/** Selects the knot so many knots further along all contours. @param {App} app @param {number} by */
function step({ editor, say }, by) {
  const all = editor.contours.flatMap(({ knots }, contour) => knots.map((_, knot) => ({ contour, knot })));
  if (all.length === 0) return;
  const first = editor.selection.places[0];
  const at = first ? all.findIndex(({ contour, knot }) => contour === first.contour && knot === first.knot) : by > 0 ? -1 : 0;
  const place = all[(at + by + all.length) % all.length];
  editor.select(Selection.of([place]));
  const knot = knotAt(editor.state, place);
  if (knot) say(`contour ${place.contour + 1}, knot ${place.knot + 1} at ${rounded(knot.x)}, ${rounded(knot.y)}`);
}

/** @type {Action[]} */
const FILE = [
  { id: "new", group: "File", label: "New drawing", keys: ["Alt+N"], run: (app) => app.keeping.startNew() },
  { id: "open", group: "File", label: "Open…", keys: ["Mod+O"], run: (app) => app.keeping.pick() },
  { id: "save", group: "File", label: (app) => app.keeping.saveLabel, keys: ["Mod+S"], run: (app) => app.keeping.save() },
  { id: "save-svg", group: "File", label: "Export SVG", keys: ["Mod+E"], divided: true, run: (app) => app.keeping.exportSvg() },
  { id: "copy-path", group: "File", label: "Copy path data", keys: ["Mod+Shift+C"], run: (app) => app.keeping.copyPath() },
  { id: "share", group: "File", label: "Copy link to this drawing", keys: ["Mod+L"], run: (app) => app.keeping.share() },
  { id: "background", group: "File", label: "Picture to trace…", divided: true, run: (app) => app.keeping.pickPicture() },
];

/** @type {Action[]} */
const EDIT = [
  {
    id: "undo", group: "Edit", label: ({ editor }) => `Undo ${editor.undoLabel ?? ""}`.trim(), keys: ["Mod+Z"],
    enabled: ({ editor }) => editor.undoLabel !== undefined, run: ({ editor }) => void editor.undo(),
  },
  {
    id: "redo", group: "Edit", label: ({ editor }) => `Redo ${editor.redoLabel ?? ""}`.trim(), keys: ["Mod+Shift+Z", "Mod+Y"],
    enabled: ({ editor }) => editor.redoLabel !== undefined, run: ({ editor }) => void editor.redo(),
  },
  { id: "copy", group: "Edit", label: "Copy contours", keys: ["Mod+C"], divided: true, enabled: hasSelection, run: (app) => app.keeping.copy() },
  { id: "paste", group: "Edit", label: "Paste contours", keys: ["Mod+V"], run: (app) => app.keeping.paste() },
  {
    id: "duplicate", group: "Edit", label: "Duplicate contours", keys: ["Mod+D"], enabled: hasSelection,
    run: ({ editor }) => editor.run("paste", { contours: selectedContours(editor.state), dx: 20, dy: -20 }),
  },
  { id: "delete", group: "Edit", label: "Delete knots", keys: ["Delete", "Backspace"], enabled: hasSelection, run: ({ editor }) => editor.run("delete") },
  {
    id: "select-all", group: "Edit", label: "Select all", keys: ["Mod+A"], divided: true,
    run: ({ editor }) => editor.select(Selection.of(editor.contours.flatMap(({ knots }, contour) => knots.map((_, knot) => ({ contour, knot }))))),
  },
  {
    id: "select-contour", group: "Edit", label: "Select whole contours", keys: ["A"], enabled: hasSelection,
    run: ({ editor }) =>
      editor.select(Selection.of(editor.selection.contours.flatMap((contour) => editor.contours[contour].knots.map((_, knot) => ({ contour, knot }))))),
  },
  { id: "next-knot", group: "Edit", label: "Next knot", keys: ["N"], run: (app) => step(app, 1) },
  { id: "previous-knot", group: "Edit", label: "Previous knot", keys: ["Shift+N"], run: (app) => step(app, -1) },
  {
    id: "escape", group: "Edit", label: "Let go, end the contour, select nothing", keys: ["Escape"], hidden: true,
    run(app) {
      if (app.pointers.cancel()) return;
      app.editor.cancel();
      app.keyboardPen.lift();
      app.editor.select(Selection.none);
    },
  },
  ...ARROWS.flatMap(([key, x, y]) => STEPS.map(([modifier, size]) => ({
    id: `nudge-${modifier}${key}`, group: /** @type {const} */ ("Edit"), label: `Move ${WORDS[key]} by ${size}`, keys: [`${modifier}${key}`], hidden: true,
    run: nudge(x * size, y * size),
  }))),
];

/** @type {Action[]} */
const KNOT = [
  ...JOINS.map(({ join, words, key }) => ({
    id: `join-${join}`, group: /** @type {const} */ ("Knot"), label: `Make it ${words}`, keys: [key], enabled: hasSelection,
    run: (/** @type {App} */ { editor }) => editor.run("setJoin", { join }),
  })),
  {
    id: "join-default", group: "Knot", label: "The spline's own join", keys: ["0"], enabled: hasSelection,
    run: ({ editor }) => editor.run("setJoin", { join: undefined }),
  },
  {
    id: "tangent", group: "Knot", label: "Give the tangent that it has", keys: ["T"], divided: true, enabled: hasSelection,
    run: (app) => app.giveTangents(),
  },
  {
    id: "free-tangent", group: "Knot", label: "Free the tangent", keys: ["Shift+T"], enabled: hasSelection,
    run: ({ editor }) => editor.run("setKnot", { fields: { tangent_in: undefined, tangent_out: undefined, curvature_in: undefined, curvature_out: undefined } }),
  },
  {
    id: "close", group: "Knot", label: "Close or open the contour", keys: ["O"], divided: true, enabled: hasSelection,
    run({ editor }) {
      const [contour] = editor.selection.contours;
      editor.run("close", { contour, closed: !editor.contours[contour].closed });
    },
  },
  { id: "open-at", group: "Knot", label: "Cut the contour here", keys: ["Shift+O"], enabled: selectedIsClosed, run: ({ editor }) => editor.run("openAt", editor.selection.only) },
  { id: "start-at", group: "Knot", label: "Make it the first knot", enabled: selectedIsClosed, run: ({ editor }) => editor.run("startAt", editor.selection.only) },
  { id: "reverse", group: "Knot", label: "Reverse the direction", keys: ["R"], enabled: hasSelection, run: ({ editor }) => editor.run("reverse") },
  {
    id: "place", group: "Knot", label: "Put a knot at the keyboard's pen", keys: ["Enter"], hidden: true,
    run: (app) => app.keyboardPen.place(false),
  },
  {
    id: "place-corner", group: "Knot", label: "Put a corner at the keyboard's pen", keys: ["Shift+Enter"], hidden: true,
    run: (app) => app.keyboardPen.place(true),
  },
];

/** @type {Action[]} */
const SHAPE = [
  { id: "mirror-x", group: "Shape", label: "Mirror left and right", keys: ["M"], enabled: hasSeveral, run: (app) => app.editor.run("transform", { map: scaling(centre(app), -1, 1) }) },
  { id: "mirror-y", group: "Shape", label: "Mirror top and bottom", keys: ["Shift+M"], enabled: hasSeveral, run: (app) => app.editor.run("transform", { map: scaling(centre(app), 1, -1) }) },
  { id: "turn", group: "Shape", label: "Turn by 15°", keys: ["Mod+ArrowLeft"], enabled: hasSeveral, run: (app) => app.editor.run("transform", { map: rotation(centre(app), Math.PI / 12) }) },
  { id: "turn-back", group: "Shape", label: "Turn by −15°", keys: ["Mod+ArrowRight"], enabled: hasSeveral, run: (app) => app.editor.run("transform", { map: rotation(centre(app), -Math.PI / 12) }) },
  { id: "larger", group: "Shape", label: "10 % larger", keys: ["Mod+ArrowUp"], enabled: hasSeveral, run: (app) => app.editor.run("transform", { map: scaling(centre(app), 1.1, 1.1) }) },
  { id: "smaller", group: "Shape", label: "10 % smaller", keys: ["Mod+ArrowDown"], enabled: hasSeveral, run: (app) => app.editor.run("transform", { map: scaling(centre(app), 1 / 1.1, 1 / 1.1) }) },
  ...["left", "centre", "right", "top", "middle", "bottom"].map((edge, i) => ({
    id: `align-${edge}`, group: /** @type {const} */ ("Shape"), label: `Align ${edge}`, enabled: hasSeveral, divided: i === 0,
    run: (/** @type {App} */ { editor }) => editor.run("align", { edge }),
  })),
  { id: "distribute-x", group: "Shape", label: "Distribute left to right", divided: true, enabled: ({ editor }) => editor.selection.count > 2, run: ({ editor }) => editor.run("distribute", { axis: "x" }) },
  { id: "distribute-y", group: "Shape", label: "Distribute bottom to top", enabled: ({ editor }) => editor.selection.count > 2, run: ({ editor }) => editor.run("distribute", { axis: "y" }) },
];

/** @type {Action[]} */
const VIEW = [
  ...LAYERS.flatMap(({ id, label, key }) => (label ? [{
    id: `layer-${id}`, group: /** @type {const} */ ("View"), label, keys: key ? [key.toUpperCase()] : undefined,
    checked: (/** @type {App} */ { settings }) => settings.values.layers[id],
    run: (/** @type {App} */ { settings }) => settings.set({ layers: { ...settings.values.layers, [id]: !settings.values.layers[id] } }),
  }] : [])),
  { id: "plot", group: "View", label: "Plot of curvature", keys: ["U"], checked: ({ settings }) => settings.values.plot, run: ({ settings }) => settings.set({ plot: !settings.values.plot }) },
  { id: "compare", group: "View", label: "Compare splines", keys: ["S"], divided: true, run: (app) => app.openCompare() },
  { id: "test", group: "View", label: "Which is the fairest?", run: (app) => app.openTest() },
  { id: "fit", group: "View", label: "Whole drawing", keys: ["Mod+0", "Home"], divided: true, run: ({ stage }) => stage.fit() },
  { id: "zoom-in", group: "View", label: "Zoom in", keys: ["+", "="], run: (app) => app.zoom(1.25) },
  { id: "zoom-out", group: "View", label: "Zoom out", keys: ["-"], run: (app) => app.zoom(0.8) },
  ...["auto", "light", "dark"].map((theme, i) => ({
    id: `theme-${theme}`, group: /** @type {const} */ ("View"), label: theme === "auto" ? "Colours of the system" : `${theme === "light" ? "Light" : "Dark"} colours`, divided: i === 0,
    checked: (/** @type {App} */ { settings }) => settings.values.theme === theme,
    run: (/** @type {App} */ { settings }) => settings.set({ theme: /** @type {any} */ (theme) }),
  })),
];

/** @type {Action[]} */
const REST = [
  ...TOOLS.map(({ id, label, key }) => ({
    id: `tool-${id}`, group: /** @type {const} */ ("Tool"), label, keys: [key.toUpperCase()], hidden: true,
    checked: (/** @type {App} */ app) => app.tool.id === id,
    run: (/** @type {App} */ app) => app.useTool(id),
  })),
  {
    id: "next-is-corner", group: "Tool", label: "Draw corners instead of smooth knots", keys: ["X"], hidden: true,
    checked: ({ settings }) => settings.values.nextIsCorner,
    run: ({ settings }) => settings.set({ nextIsCorner: !settings.values.nextIsCorner }),
  },
  { id: "help", group: "Help", label: "How to draw, with examples", keys: ["F1"], run: (app) => app.openHelp() },
  { id: "keys", group: "Help", label: "All keys", keys: ["?"], run: (app) => app.openKeys() },
];

export const ACTIONS = [...FILE, ...EDIT, ...KNOT, ...SHAPE, ...VIEW, ...REST];

/** @param {Action} action @param {App} app */
export const labelOf = (action, app) => (typeof action.label === "string" ? action.label : action.label(app));

/** @param {Action} action @param {App} app */
export const isEnabled = (action, app) => action.enabled?.(app) ?? true;

/** @param {string} id */
export function actionOf(id) {
  const action = ACTIONS.find((action) => action.id === id);
  if (!action) throw new Error(`there is no action ${id}`);
  return action;
}

/** The pen that the arrow keys move and that Enter puts a knot with. */
export class KeyboardPen {
  /** @type {import("./core/geometry.js").Point | null} */
  #at = null;

  /** @param {App} app */
  constructor(app) {
    this.app = app;
  }

  /** @param {number} dx @param {number} dy */
  move(dx, dy) {
    const { editor, stage, say } = this.app;
    editor.cancel();
    // Steps are larger than those of knots: 10, with Shift 100, with Alt 1.
    const from = this.#at ?? selectedKnots(editor.committed)[0] ?? stage.viewport.toDrawing({ x: stage.viewport.width / 2, y: stage.viewport.height / 2 });
    const begin = this.#at ? from : { x: Math.round(from.x / 10) * 10, y: Math.round(from.y / 10) * 10 };
    this.#at = { x: rounded(begin.x + 10 * dx), y: rounded(begin.y + 10 * dy) };
    this.#show();
    say(`pen at ${this.#at.x}, ${this.#at.y}`);
  }

  #show() {
    const { editor, stage } = this.app;
    if (!this.#at) return;
    const kept = editor.committed;
    const hit = this.#knotBelow();
    if (!hit && kept.selection.count > 0) editor.preview([placing(kept, this.#at)]);
    stage.show({ mark: { ...this.#at, closes: hit !== null && meeting(kept, hit) !== null } });
  }

  #knotBelow() {
    const at = this.#at;
    if (!at) return null;
    for (const [contour, { knots }] of contoursOf(this.app.editor.committed).entries()) {
      const knot = knots.findIndex(({ x, y }) => Math.hypot(x - at.x, y - at.y) < 1e-6);
      if (knot >= 0) return { contour, knot };
    }
    return null;
  }

  /** @param {boolean} corner */
  place(corner) {
    const { editor, tool } = this.app;
    if (tool.id !== "draw" || !this.#at) return;
    editor.cancel();
    const hit = this.#knotBelow();
    const join = corner !== this.app.settings.values.nextIsCorner ? { join: /** @type {const} */ ("corner") } : {};
    const command = hit ? meeting(editor.committed, hit) : placing(editor.committed, { ...this.#at, ...join });
    if (command) editor.run(.../** @type {[keyof typeof COMMANDS, any]} */ (command));
    else if (hit) editor.select(Selection.one(hit.contour, hit.knot));
    if (command?.[0] === "close") editor.select(Selection.none);
    this.app.stage.show({ mark: this.#at });
  }

  lift() {
    this.#at = null;
    this.app.stage.show({});
  }
}

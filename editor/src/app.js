// The parts of the editor, put together.

import { KeyboardPen } from "./actions.js";
import { knotAt } from "./core/commands.js";
import { Editor } from "./core/editor.js";
import { Settings } from "./core/settings.js";
import { rounded } from "./core/geometry.js";
import { CurveStore } from "./curves/store.js";
import { packageCurves, splineInfo } from "./curves/curves.js";
import { Keeping } from "./keeping/keeping.js";
import { listenToKeys } from "./keys.js";
import { buildCompare } from "./panels/compare.js";
import { ask, complain, dialog, openHelp, openKeys } from "./panels/dialogs.js";
import { byId } from "./panels/dom.js";
import { buildInspector } from "./panels/inspector.js";
import { buildMenus } from "./panels/menus.js";
import { buildPlot } from "./panels/plot.js";
import { buildRail } from "./panels/rail.js";
import { buildStatus } from "./panels/status.js";
import { buildWelcome } from "./panels/welcome.js";
import { openTest } from "./panels/test.js";
import { TOOLS } from "./tools/tools.js";
import { Pointers } from "./view/pointers.js";
import { Stage } from "./view/stage.js";

/** @param {() => Storage} get @returns {Storage | null} the browser's store, where it is allowed */
function storage(get) {
  try {
    return get();
  } catch {
    return null;
  }
}

export class App {
  editor = new Editor();
  settings = new Settings(storage(() => localStorage));
  store = new CurveStore(packageCurves);
  /** @type {import("./tools/tool.js").Tool} */
  tool = TOOLS[0];
  /** @type {Set<() => void>} */
  #toolListeners = new Set();

  constructor() {
    const canvas = /** @type {HTMLCanvasElement} */ (byId("canvas"));
    this.#applyTheme();
    this.stage = new Stage(canvas, this.editor, this.store, this.settings);
    this.pointers = new Pointers(this, () => this.tool);
    this.keyboardPen = new KeyboardPen(this);
    this.keeping = new Keeping(this);
    this.say = buildStatus(this);
    buildRail(this);
    buildMenus(this);
    buildInspector(this);
    buildPlot(this);
    this.compare = buildCompare(this);
    buildWelcome(this);
    listenToKeys(this);
    this.settings.subscribe(() => this.#applyTheme());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.stage.restyle());
  }

  async begin() {
    this.stage.fit();
    await this.keeping.begin();
    this.useTool(this.editor.contours.length === 0 ? "draw" : "select");
  }

  /** @param {string} id */
  useTool(id) {
    const tool = TOOLS.find((tool) => tool.id === id);
    if (!tool) return;
    this.pointers.cancel();
    this.editor.cancel();
    this.tool.leave?.(this);
    this.tool = tool;
    this.stage.hasFrame = tool.frame ?? false;
    this.stage.show({});
    for (const listener of this.#toolListeners) listener();
    this.pointers.hoverAgain();
  }

  /** @param {() => void} listener */
  onTool(listener) {
    this.#toolListeners.add(listener);
  }

  /** @param {number} glyph */
  showGlyph(glyph) {
    this.editor.showGlyph(glyph);
    this.stage.fit();
  }

  /** @param {number} factor */
  zoom(factor) {
    this.stage.viewport.zoom(factor);
    this.stage.invalidate();
  }

  /** Gives the selected knots the tangents that the curve has there. */
  giveTangents() {
    const { editor, stage } = this;
    const changes = editor.selection.places.flatMap((place) => {
      const solved = stage.curves[place.contour].knots[place.knot];
      const knot = knotAt(editor.state, place);
      if (!solved || !knot) return [];
      const vector = (/** @type {number | null} */ angle) =>
        angle === null ? undefined : /** @type {[number, number]} */ ([rounded(Math.cos(angle), 4), rounded(Math.sin(angle), 4)]);
      const [tangent_in, tangent_out] = [vector(solved.direction_in), vector(solved.direction_out)];
      // Of a smooth knot both sides are one direction, whatever rounding says.
      const smooth = solved.join !== "corner" && tangent_in && tangent_out;
      return [{ place, fields: smooth ? { tangent_in: tangent_out, tangent_out } : { tangent_in, tangent_out } }];
    });
    if (changes.length === 0) return;
    editor.preview(changes.map((args) => ["setKnotAt", args]), "give tangent");
    editor.commit();
  }

  /** @param {boolean} [open] left out: the other way */
  openCompare(open = Boolean(this.compare.panel.hidden)) {
    this.compare.panel.hidden = !open;
    if (open && this.settings.values.compare.length === 0) this.settings.set({ compare: ["euler", "hobby"].filter((name) => name !== this.editor.state.document.spline) });
    if (!open) this.settings.set({ compare: [] });
    this.compare.update();
    // Beside the panel, not below it.
    this.stage.inset = open ? this.compare.panel.offsetLeft + this.compare.panel.offsetWidth : 0;
    this.stage.fit();
  }

  openTest() {
    openTest(this);
  }

  openHelp() {
    openHelp(this);
  }

  openKeys() {
    openKeys(this);
  }

  /** @param {import("./examples.js").Example} example */
  openExample({ document, comb, plot }) {
    const { layers } = this.settings.values;
    this.settings.set({ layers: { ...layers, comb: comb ?? layers.comb }, plot: plot ?? this.settings.values.plot });
    this.keeping.openNew(document, `${document.glyphs[0].name}.json`);
    this.useTool("select");
    this.stage.fit();
  }

  info(/** @type {string} */ name) {
    const info = splineInfo(name);
    if (!info) throw new Error(`there is no spline ${name}`);
    return info;
  }

  complain = complain;
  ask = ask;
  dialog = dialog;

  /** @param {string} name @param {boolean} changed */
  showName(name, changed) {
    byId("name").textContent = changed ? `${name} •` : name;
    document.title = `${changed ? "• " : ""}${name} – faircurve`;
  }

  #applyTheme() {
    const { theme } = this.settings.values;
    if (theme === "auto") delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = theme;
  }
}

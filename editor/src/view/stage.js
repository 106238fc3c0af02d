// The canvas: it draws a frame when something has changed, and says what is under a point.

import { boxOf, distance, union } from "../core/geometry.js";
import { choiceOf } from "../core/document.js";
import { contoursOf, selectedKnots } from "../core/commands.js";
import { Background } from "./background.js";
import { drawLayers, handlesOf } from "./layers.js";
import { frameHandles } from "./frame.js";
import { Viewport } from "./viewport.js";
import { colourOf } from "./colours.js";

/** @typedef {import("../core/geometry.js").Point} Point */
/** @typedef {import("../core/selection.js").Place} Place */
/** @typedef {import("./scene.js").Overlay} Overlay */

/** Colours that are told apart on light and dark paper, with the common kinds of colour blindness, too. */
export const COMPARE_COLOURS = ["#e0653a", "#2a9d8f", "#7b5cd6", "#c9962a", "#d1478c", "#3f8fd2", "#6a8f2f", "#8a6d5b"];

/** Pixels within which a pointer hits; a finger is wider than a mouse. */
const REACH = { mouse: 8, pen: 10, touch: 20 };

export class Stage {
  viewport = new Viewport();
  background = new Background();
  /** @type {Overlay} */
  #overlay = {};
  #frame = 0;
  /** Colours of the theme, read from the style sheet when it changes. @type {Record<string, string> | null} */
  #colours = null;
  /** @type {(() => void)[]} */
  #afterFrame = [];

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {import("../core/editor.js").Editor} editor
   * @param {import("../curves/store.js").CurveStore} store
   * @param {import("../core/settings.js").Settings} settings
   */
  constructor(canvas, editor, store, settings) {
    this.canvas = canvas;
    this.editor = editor;
    this.store = store;
    this.settings = settings;
    // Desynchronized, the drawing doesn't wait for the rest of the page: half of a frame's time, and the curve stays under the hand.
    this.context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d", { alpha: false, desynchronized: true }));
    editor.subscribe(() => this.invalidate());
    settings.subscribe(() => this.restyle());
    new ResizeObserver(() => this.#resize()).observe(canvas);
    this.#resize();
  }

  get curves() {
    return this.store.seen(this.editor);
  }

  /** @param {Overlay} overlay */
  show(overlay) {
    this.#overlay = overlay;
    this.invalidate();
  }

  get overlay() {
    return this.#overlay;
  }

  /** The theme or the settings have changed. */
  restyle() {
    this.#colours = null;
    this.invalidate();
  }

  /** @param {() => void} listener called after each frame */
  afterFrame(listener) {
    this.#afterFrame.push(listener);
  }

  /** Draws before the next frame of the screen. */
  invalidate() {
    this.#frame ||= requestAnimationFrame(() => this.draw());
  }

  draw() {
    cancelAnimationFrame(this.#frame);
    this.#frame = 0;
    const { context, canvas, viewport } = this;
    const ratio = canvas.width / viewport.width;
    this.#colours ??= colourOf(canvas);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.fillStyle = this.#colours.paper;
    context.fillRect(0, 0, viewport.width, viewport.height);
    drawLayers({
      context, ratio, viewport,
      state: this.editor.state,
      contours: this.editor.contours,
      curves: this.curves,
      settings: this.settings.values,
      colours: this.#colours,
      overlay: { ...this.#overlay, frame: this.#overlay.frame ?? this.frame },
      compared: this.compared,
      background: this.background,
      isInHand: this.editor.isPreviewing,
      combReference: this.combReference,
    });
    for (const listener of this.#afterFrame) listener();
  }

  /** The curvature by which combs are scaled: that of the kept drawing, so that teeth grow when a dragged curve bends. */
  get combReference() {
    const { document } = this.editor.committed;
    const kept = contoursOf(this.editor.committed).map((contour) => this.store.canonical(contour, choiceOf(document, contour)));
    return Math.max(0, ...(kept.length > 0 ? kept : this.curves).map((curve) => curve.typicalCurvature));
  }

  /** Other splines on the same knots. */
  get compared() {
    const { compare, compareParams } = this.settings.values;
    if (compare.length === 0) return [];
    const { contours } = this.editor;
    return compare.map((name) => ({
      name,
      colour: COMPARE_COLOURS[compare.indexOf(name) % COMPARE_COLOURS.length],
      curves: contours.map((contour) => this.store.canonical(contour, { spline: name, params: compareParams[name] ?? {} })),
    }));
  }

  /** The frame around what is selected, where the tool has one. Set by the tool. */
  hasFrame = false;

  /** @returns {import("../core/geometry.js").Box | null} */
  get frame() {
    if (!this.hasFrame || this.editor.selection.count < 2) return null;
    const box = boxOf(selectedKnots(this.editor.state));
    return box && (box.x1 > box.x0 || box.y1 > box.y0) ? box : null;
  }

  #resize() {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    const before = { width: this.viewport.width, height: this.viewport.height };
    const ratio = window.devicePixelRatio || 1;
    this.canvas.width = Math.round(clientWidth * ratio);
    this.canvas.height = Math.round(clientHeight * ratio);
    this.viewport.width = clientWidth;
    this.viewport.height = clientHeight;
    // What was in the middle stays there.
    if (before.width > 1) this.viewport.pan((clientWidth - before.width) / 2, (clientHeight - before.height) / 2);
    this.draw();
  }

  /** Pixels on the left that a panel covers. */
  inset = 0;

  /** All of the drawing in view; an empty one shows the room of a letter. */
  fit() {
    const box = this.curves.reduce((/** @type {import("../core/geometry.js").Box | null} */ box, curve) => union(box, curve.box), null);
    const empty = { x0: -100, y0: -250, x1: 700, y1: 800 };
    const { viewport } = this;
    // A panel takes its room only where enough is left.
    const inset = this.inset < viewport.width / 2 ? this.inset : 0;
    viewport.width -= inset;
    viewport.fit(box && (box.x1 > box.x0 || box.y1 > box.y0) ? box : union(box, empty) ?? empty);
    viewport.width += inset;
    viewport.pan(inset, 0);
    this.invalidate();
  }

  /** @param {Point} screen @param {keyof typeof REACH} kind @returns {Place | null} */
  knotAt(screen, kind) {
    let best = null;
    let reach = REACH[kind] + 1;
    this.editor.contours.forEach(({ knots }, contour) => knots.forEach((knot, k) => {
      const off = distance(this.viewport.toScreen(knot), screen);
      // Of knots in one place the selected one is meant, so that it can be moved away.
      const d = this.editor.selection.has(contour, k) ? off - 1 : off;
      if (d < reach) [best, reach] = [{ contour, knot: k }, d];
    }));
    return best;
  }

  /** @param {Point} screen @param {keyof typeof REACH} kind */
  handleAt(screen, kind) {
    if (!this.settings.values.layers.handles) return null;
    for (const [contour, { knots }] of this.editor.contours.entries()) {
      for (const [knot, data] of knots.entries()) {
        const hit = handlesOf(this.viewport, data).find(({ tip }) => distance(tip, screen) <= REACH[kind]);
        if (hit) return { place: { contour, knot }, side: hit.side };
      }
    }
    return null;
  }

  /** @param {Point} screen @param {keyof typeof REACH} kind */
  frameHandleAt(screen, kind) {
    const box = this.frame;
    if (!box) return null;
    const handle = frameHandles(this.viewport, box).find((h) => distance(h, screen) <= REACH[kind]);
    return handle ? { handle, box } : null;
  }

  /** The curve under a point of the screen. @param {Point} screen @param {keyof typeof REACH} kind */
  curveAt(screen, kind) {
    const at = this.viewport.toDrawing(screen);
    const reach = REACH[kind] / this.viewport.scale;
    let best = null;
    for (const [contour, curve] of this.curves.entries()) {
      const box = curve.box;
      if (!box || at.x < box.x0 - reach || at.x > box.x1 + reach || at.y < box.y0 - reach || at.y > box.y1 + reach) continue;
      const nearest = curve.nearest(at);
      if (nearest && nearest.distance <= reach && nearest.distance < (best?.distance ?? Infinity)) best = { ...nearest, contour };
    }
    return best;
  }
}

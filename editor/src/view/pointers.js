// Pointers of the canvas: mouse, pen and fingers become presses of the tool; two fingers, the wheel, the space bar
// and the middle button move and zoom the paper.

import { distance } from "../core/geometry.js";
import { hand } from "../tools/hand.js";

/** @typedef {import("../tools/tool.js").Pointer} Pointer */
/** @typedef {import("../tools/tool.js").Tool} Tool */
/** @typedef {import("../tools/tool.js").Studio} Studio */

/** Milliseconds and pixels within which a second press makes a double click. */
const DOUBLE = { time: 400, reach: 6 };

export class Pointers {
  /** @type {import("../tools/tool.js").Drag | null} */
  #drag = null;
  /** Fingers on the canvas. @type {Map<number, {x: number, y: number}>} */
  #fingers = new Map();
  #spaceIsDown = false;
  #lastPress = { time: -Infinity, x: 0, y: 0, clicks: 0 };
  /** Where the pointer is, while it hovers. @type {PointerEvent | null} */
  #hovering = null;

  /** @param {Studio} studio @param {() => Tool} tool */
  constructor(studio, tool) {
    this.studio = studio;
    this.tool = tool;
    const { canvas } = studio.stage;
    canvas.addEventListener("pointerdown", (event) => this.#down(event));
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    canvas.addEventListener("pointerup", (event) => this.#up(event));
    canvas.addEventListener("pointercancel", (event) => this.#lost(event));
    canvas.addEventListener("pointerleave", () => this.#left());
    canvas.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    addEventListener("keydown", (event) => this.#key(event, true));
    addEventListener("keyup", (event) => this.#key(event, false));
  }

  get isDragging() {
    return this.#drag !== null;
  }

  /** Ends what is in the hand as if it hadn't begun. @returns {boolean} whether there was something */
  cancel() {
    const drag = this.#drag;
    this.#drag = null;
    drag?.cancel?.();
    return drag !== null;
  }

  /** Shows what a press would do now, such as after a key. */
  hoverAgain() {
    if (this.#hovering && !this.#drag) this.#hover(this.#hovering);
  }

  /** @param {PointerEvent} event @param {number} [clicks] @returns {Pointer} */
  #at(event, clicks = 0) {
    const box = this.studio.stage.canvas.getBoundingClientRect();
    const screen = { x: event.clientX - box.left, y: event.clientY - box.top };
    const kind = event.pointerType === "touch" || event.pointerType === "pen" ? event.pointerType : "mouse";
    const point = this.studio.stage.viewport.toDrawing(screen);
    return { screen, point, kind, shift: event.shiftKey, alt: event.altKey, ctrl: event.ctrlKey || event.metaKey, clicks };
  }

  /** @param {PointerEvent} event */
  #down(event) {
    const { canvas } = this.studio.stage;
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    event.preventDefault();
    if (event.pointerType === "touch") {
      this.#fingers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
      if (this.#fingers.size === 2) {
        this.cancel();
        return;
      }
      if (this.#fingers.size > 2) return;
    }
    if (this.#drag || event.button === 2) return;
    const last = this.#lastPress;
    const again = event.timeStamp - last.time < DOUBLE.time && Math.hypot(event.clientX - last.x, event.clientY - last.y) < DOUBLE.reach;
    const clicks = again ? last.clicks + 1 : 1;
    this.#lastPress = { time: event.timeStamp, x: event.clientX, y: event.clientY, clicks };
    const tool = this.#spaceIsDown || event.button === 1 ? hand : this.tool();
    this.#drag = tool.press(this.studio, this.#at(event, clicks)) ?? {};
    if (tool === hand) canvas.style.cursor = "grabbing";
  }

  /** @param {PointerEvent} event */
  #move(event) {
    const finger = this.#fingers.get(event.pointerId);
    if (finger && this.#fingers.size === 2) {
      this.#pinch(event, finger);
      return;
    }
    if (this.#drag) this.#drag.move?.(this.#at(event));
    else if (event.pointerType !== "touch") this.#hover(event);
  }

  /** @param {PointerEvent} event */
  #hover(event) {
    this.#hovering = event;
    const { stage } = this.studio;
    const tool = this.#spaceIsDown ? hand : this.tool();
    stage.canvas.style.cursor = tool.hover(this.studio, this.#at(event));
  }

  /** @param {PointerEvent} event @param {{x: number, y: number}} finger */
  #pinch(event, finger) {
    const { viewport } = this.studio.stage;
    const [other] = [...this.#fingers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
    const now = { x: event.offsetX, y: event.offsetY };
    const [before, after] = [distance(finger, other), distance(now, other)];
    const middle = { x: (now.x + other.x) / 2, y: (now.y + other.y) / 2 };
    viewport.pan((now.x - finger.x) / 2, (now.y - finger.y) / 2);
    if (before > 0 && after > 0) viewport.zoom(after / before, middle);
    this.#fingers.set(event.pointerId, now);
    this.studio.stage.invalidate();
  }

  /** @param {PointerEvent} event */
  #up(event) {
    const pinched = this.#fingers.size > 1;
    this.#fingers.delete(event.pointerId);
    if (pinched) return;
    const drag = this.#drag;
    this.#drag = null;
    drag?.end?.(this.#at(event));
    if (event.pointerType !== "touch") this.#hover(event);
  }

  /** @param {PointerEvent} event */
  #lost(event) {
    this.#fingers.delete(event.pointerId);
    this.cancel();
  }

  #left() {
    this.#hovering = null;
    if (!this.#drag) this.tool().leave?.(this.studio);
  }

  /** @param {WheelEvent} event */
  #wheel(event) {
    event.preventDefault();
    const { viewport } = this.studio.stage;
    const unit = event.deltaMode === 1 ? 16 : 1;
    if (event.ctrlKey || event.metaKey) {
      viewport.zoom(Math.exp(-event.deltaY * unit * 0.005), { x: event.offsetX, y: event.offsetY });
    } else {
      const [dx, dy] = event.shiftKey ? [event.deltaY, event.deltaX] : [event.deltaX, event.deltaY];
      viewport.pan(-dx * unit, -dy * unit);
    }
    this.studio.stage.invalidate();
  }

  /** @param {KeyboardEvent} event @param {boolean} down */
  #key(event, down) {
    const onCanvas = document.activeElement === this.studio.stage.canvas || document.activeElement === document.body;
    if (event.key === " " && onCanvas && !event.ctrlKey) {
      this.#spaceIsDown = down;
      if (down) event.preventDefault();
      if (!this.#drag) this.studio.stage.canvas.style.cursor = down ? "grab" : "";
    }
    if (event.key === "Shift") this.hoverAgain();
  }
}

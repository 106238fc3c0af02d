// The drawing under edit: its state, its history, and a change that is still in the hand. Without DOM.

import { blank } from "./document.js";
import { COMMANDS, contoursOf } from "./commands.js";
import { History } from "./history.js";
import { Selection } from "./selection.js";

/** @typedef {import("./commands.js").State} State */

export class Editor {
  /** @type {History<State>} */
  #history = new History({ document: blank(), glyph: 0, selection: Selection.none });
  /** A change in the hand, such as a knot being dragged. @type {{state: State, label: string} | null} */
  #preview = null;
  /** @type {Set<() => void>} */
  #listeners = new Set();

  /** What is seen: with the change in the hand. */
  get state() {
    return this.#preview?.state ?? this.#history.state;
  }

  /** What is kept: without the change in the hand. */
  get committed() {
    return this.#history.state;
  }

  get isPreviewing() {
    return this.#preview !== null;
  }

  get contours() {
    return contoursOf(this.state);
  }

  get selection() {
    return this.state.selection;
  }

  get undoLabel() {
    return this.#history.undoLabel;
  }

  get redoLabel() {
    return this.#history.redoLabel;
  }

  /**
   * Does a command. A step is undone together with the one before it if both have the same `merge`.
   * @param {keyof typeof COMMANDS} name
   * @param {any} [args]
   * @param {string} [merge]
   */
  run(name, args = {}, merge) {
    this.#preview = null;
    const { label, run } = COMMANDS[name];
    const state = run(this.committed, args);
    if (state !== this.committed) this.#history.push(state, label, merge);
    this.#changed();
  }

  /**
   * Shows what a command, or several, would do to the kept state.
   * @param {[name: keyof typeof COMMANDS, args: any][]} commands
   * @param {string} [label] the last command's, if left out
   */
  preview(commands, label) {
    const state = commands.reduce((state, [name, args]) => COMMANDS[name].run(state, args), this.committed);
    this.#preview = { state, label: label ?? COMMANDS[commands[commands.length - 1][0]].label };
    this.#changed();
  }

  /** Keeps what is shown. */
  commit() {
    if (!this.#preview) return;
    const { state, label } = this.#preview;
    this.#preview = null;
    if (state.document !== this.committed.document) this.#history.push(state, label);
    this.#changed();
  }

  /** Forgets what is only shown. */
  cancel() {
    if (!this.#preview) return;
    this.#preview = null;
    this.#changed();
  }

  /** @param {Selection} selection Not a step of its own. */
  select(selection) {
    this.#preview = null;
    this.#history.amend({ ...this.committed, selection });
    this.#changed();
  }

  /** @param {number} glyph Not a step of its own. */
  showGlyph(glyph) {
    if (!this.committed.document.glyphs[glyph]) return;
    this.#preview = null;
    this.#history.amend({ ...this.committed, glyph, selection: Selection.none });
    this.#changed();
  }

  undo() {
    this.#preview = null;
    const done = this.#history.undo();
    if (done) this.#changed();
    return done;
  }

  redo() {
    this.#preview = null;
    const done = this.#history.redo();
    if (done) this.#changed();
    return done;
  }

  /** @param {() => void} listener called after every change @returns {() => void} stops it */
  subscribe(listener) {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  #changed() {
    for (const listener of this.#listeners) listener();
  }
}

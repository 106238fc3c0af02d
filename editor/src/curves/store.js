// The curves of the drawing. A kept contour has its canonical curve, which is a function of the document
// alone; a contour in the hand has one that follows it without jumping.

import { choiceOf } from "../core/document.js";
import { contoursOf } from "../core/commands.js";

/** @typedef {import("../core/document.js").Contour} Contour */
/** @typedef {import("../core/document.js").Choice} Choice */
/** @typedef {import("./curves.js").Curves} Curves */
/** @typedef {import("./curves.js").Solved} Solved */
/** @typedef {import("./curves.js").Following} Following */

/** One word for a spline with its parameters. @param {Choice} choice */
export const wordFor = ({ spline, params }) => `${spline} ${JSON.stringify(params)}`;

export class CurveStore {
  /** Canonical curves, for as long as anything holds the contour. @type {WeakMap<Contour, Map<string, Solved>>} */
  #kept = new WeakMap();
  /** What follows the hand: by contour's index. @type {Map<number, {from: Contour, word: string, following: Following, seen: Contour, solved: Solved}>} */
  #inHand = new Map();

  /** @param {Curves} curves */
  constructor(curves) {
    this.curves = curves;
  }

  /**
   * The canonical curve.
   * @param {Contour} contour
   * @param {Choice} choice
   * @returns {Solved}
   */
  canonical(contour, choice) {
    const bySpline = this.#kept.get(contour) ?? new Map();
    this.#kept.set(contour, bySpline);
    const word = wordFor(choice);
    let solved = bySpline.get(word);
    if (!solved) bySpline.set(word, (solved = this.curves.solve(contour, choice)));
    return solved;
  }

  /**
   * The curves that are seen: one for each contour of the open glyph.
   * @param {import("../core/editor.js").Editor} editor
   * @returns {Solved[]}
   */
  seen(editor) {
    const kept = contoursOf(editor.committed);
    if (!editor.isPreviewing) this.#release();
    return editor.contours.map((contour, index) => {
      const choice = choiceOf(editor.state.document, contour);
      if (!editor.isPreviewing || contour === kept[index]) return this.canonical(contour, choice);
      return this.#followed(index, kept[index], contour, choice);
    });
  }

  /**
   * @param {number} index
   * @param {Contour | undefined} from what is kept there
   * @param {Contour} contour
   * @param {Choice} choice
   */
  #followed(index, from, contour, choice) {
    if (!from) return this.curves.solve(contour, choice);
    try {
      return this.#follow(index, from, contour, choice);
    } catch {
      // What is given has no meaning at this moment; the canonical way says so.
      this.#inHand.get(index)?.following.free();
      this.#inHand.delete(index);
      return this.curves.solve(contour, choice);
    }
  }

  /**
   * @param {number} index
   * @param {Contour} from
   * @param {Contour} contour
   * @param {Choice} choice
   */
  #follow(index, from, contour, choice) {
    const word = wordFor(choice);
    let held = this.#inHand.get(index);
    if (!held || held.from !== from || held.word !== word) {
      held?.following.free();
      const following = this.curves.follow(from, choice);
      held = { from, word, following, seen: from, solved: following.solved() };
      this.#inHand.set(index, held);
    }
    if (held.seen !== contour) {
      held.solved = held.following.become(contour);
      held.seen = contour;
    }
    return held.solved;
  }

  #release() {
    for (const { following } of this.#inHand.values()) following.free();
    this.#inHand.clear();
  }
}

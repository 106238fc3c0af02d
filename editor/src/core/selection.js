// Which knots are selected: a set of (contour, knot), never changed in place.

/** @typedef {{contour: number, knot: number}} Place */

export class Selection {
  static none = new Selection(new Map());

  /** @param {ReadonlyMap<number, ReadonlySet<number>>} byContour without empty sets */
  constructor(byContour) {
    this.byContour = byContour;
  }

  /** @param {Iterable<Place>} places */
  static of(places) {
    /** @type {Map<number, Set<number>>} */
    const byContour = new Map();
    for (const { contour, knot } of places) {
      const knots = byContour.get(contour) ?? new Set();
      byContour.set(contour, knots.add(knot));
    }
    return byContour.size === 0 ? Selection.none : new Selection(byContour);
  }

  /** @param {number} contour @param {number} knot */
  static one(contour, knot) {
    return Selection.of([{ contour, knot }]);
  }

  /** In order of contours and knots. @returns {Place[]} */
  get places() {
    const places = [...this.byContour].flatMap(([contour, knots]) => [...knots].map((knot) => ({ contour, knot })));
    return places.sort((a, b) => a.contour - b.contour || a.knot - b.knot);
  }

  get count() {
    return [...this.byContour.values()].reduce((sum, knots) => sum + knots.size, 0);
  }

  /** The only selected knot, if there is one alone. @returns {Place | null} */
  get only() {
    return this.count === 1 ? this.places[0] : null;
  }

  /** Contours with a selected knot, in order. */
  get contours() {
    return [...this.byContour.keys()].sort((a, b) => a - b);
  }

  /** @param {number} contour @param {number} knot */
  has(contour, knot) {
    return this.byContour.get(contour)?.has(knot) ?? false;
  }

  /** @param {Iterable<Place>} places */
  with(places) {
    return Selection.of([...this.places, ...places]);
  }

  /** Every place that is in one of both alone. @param {Place[]} places */
  toggled(places) {
    const other = Selection.of(places);
    const kept = this.places.filter((p) => !other.has(p.contour, p.knot));
    return Selection.of([...kept, ...places.filter((p) => !this.has(p.contour, p.knot))]);
  }
}

// What the user has set and the browser remembers: none of it is part of a drawing.

export const DEFAULTS = {
  theme: /** @type {"auto" | "light" | "dark"} */ ("auto"),
  /** Layers by name. @type {Record<string, boolean>} */
  layers: { grid: true, fill: true, comb: false, extrema: false, beziers: false, handles: true, knots: true },
  /** Snapping by source. @type {Record<string, boolean>} */
  snap: { grid: true, knots: true, axes: true, extrema: false },
  /** In units. */
  grid: 1,
  /** Pixels of a comb's longest tooth. */
  comb: 60,
  /** Of the Béziers that are written, in units. */
  accuracy: 0.1,
  /** Whether the plot of curvature is shown. */
  plot: false,
  /** Splines compared, by name. @type {string[]} */
  compare: [],
  compareSide: false,
  /** Parameters with which splines are compared. @type {Record<string, Record<string, number | string>>} */
  compareParams: {},
  nextIsCorner: false,
};

/** @typedef {typeof DEFAULTS} Values */

export class Settings {
  /** @type {Set<() => void>} */
  #listeners = new Set();

  /** @param {Pick<Storage, "getItem" | "setItem"> | null} storage @param {string} [key] */
  constructor(storage, key = "faircurve.settings") {
    this.storage = storage;
    this.key = key;
    /** @type {Values} */
    this.values = { ...DEFAULTS, ...this.#stored() };
  }

  /** What is stored, as far as it has the type of its default. @returns {Partial<Values>} */
  #stored() {
    try {
      const stored = JSON.parse(this.storage?.getItem(this.key) ?? "{}");
      const fits = Object.entries(DEFAULTS).filter(([key, value]) =>
        typeof stored[key] === typeof value && stored[key] !== null && Array.isArray(stored[key]) === Array.isArray(value));
      return Object.fromEntries(fits.map(([key]) => [key, stored[key]]));
    } catch {
      return {};
    }
  }

  /** @param {Partial<Values>} changes */
  set(changes) {
    this.values = { ...this.values, ...changes };
    try {
      this.storage?.setItem(this.key, JSON.stringify(this.values));
    } catch {
      // A full or forbidden store only means that nothing is remembered.
    }
    for (const listener of this.#listeners) listener();
  }

  /** @param {() => void} listener */
  subscribe(listener) {
    this.#listeners.add(listener);
  }
}

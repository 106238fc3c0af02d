import { Beziers } from "./beziers.js";
import { Curve } from "./curve.js";
import { checked, FaircurveError } from "./error.js";
import type { Contour, Knot, SplineChoice } from "./document.js";
import { knotRow, knotRows, splineOf } from "./knots.js";
import { type Solver, solverOf, type wasm } from "./solver.js";

type NamedChoice = SplineChoice & { spline: string };

/** A moment of a {@link LiveContour}, to come back to. Cheap: it shares what doesn't change. */
export class Snapshot {
  /** @internal */
  readonly state: {
    live: wasm.Live;
    solver: Solver;
    knots: readonly Knot[];
    closed: boolean;
    choice: NamedChoice;
  };

  /** @internal */
  constructor(state: Snapshot["state"]) {
    this.state = state;
  }
}

/**
 * A contour under the hand: knots move, come and go, and the curve follows.
 *
 * Each curve starts from the one before it and stays on its branch, so that it doesn't jump while a knot is dragged;
 * {@link settle} gives the canonical one, which the same contour has when it is opened anew. Edits take effect
 * when {@link curve} or {@link beziers} is asked for, so that several cost one solution.
 */
export class LiveContour {
  #live: wasm.Live;
  /** The module of `#live`; that of the spline is another when the spline was changed and not yet solved for. */
  #solver: Solver;
  #knots: Knot[];
  #closed: boolean;
  #choice: NamedChoice;
  #curve: Curve | undefined;
  #stale = false;

  /** The contour with its canonical curve. */
  constructor(contour: Contour) {
    const { name, built, solver } = checked(() => splineOf(contour));
    this.#knots = contour.knots.map((knot) => ({ ...knot }));
    this.#closed = contour.closed ?? false;
    this.#choice = { spline: name, params: contour.params };
    this.#solver = solver;
    this.#live = checked(() => new solver.Live(built, knotRows(contour.knots), this.#closed));
  }

  /** The knots with every edit. */
  get knots(): readonly Readonly<Knot>[] {
    return this.#knots;
  }

  get closed(): boolean {
    return this.#closed;
  }

  /** The contour as a document holds it. */
  get contour(): Contour {
    return { ...this.#choice, closed: this.#closed, knots: this.#knots.map((knot) => ({ ...knot })) };
  }

  /** Moves a knot. */
  move(index: number, x: number, y: number): void {
    const knot = this.#knot(index);
    this.#knots[index] = { ...knot, x, y };
    this.#live.move_to(index, x, y);
    this.#stale = true;
  }

  /** Changes what is said of a knot: its join, what is given there. A key that is `undefined` is no longer given. */
  change(index: number, changes: Partial<Knot>): void {
    const knot = { ...this.#knot(index), ...changes };
    const row = knotRow(knot);
    this.#knots[index] = knot;
    this.#live.set_knot(index, row);
    this.#stale = true;
  }

  /** Changes all knots at once, as in a rotation. */
  setKnots(knots: readonly Knot[]): void {
    const rows = knotRows(knots);
    this.#knots = knots.map((knot) => ({ ...knot }));
    this.#live.set_knots(rows);
    this.#stale = true;
  }

  /** Puts a knot in at that index, 0 to the number of knots, before the one that is there. */
  insert(index: number, knot: Knot): void {
    if (!(Number.isInteger(index) && index >= 0 && index <= this.#knots.length)) throw this.#noSuchKnot(index);
    const row = knotRow(knot);
    this.#knots.splice(index, 0, { ...knot });
    this.#live.insert(index, row);
    this.#stale = true;
  }

  /** Takes a knot out. */
  delete(index: number): void {
    this.#knot(index);
    this.#knots.splice(index, 1);
    this.#live.remove(index);
    this.#stale = true;
  }

  /** Closes the contour, or opens it between its last knot and its first. */
  setClosed(closed: boolean): void {
    this.#closed = closed;
    this.#live.set_closed(closed);
    this.#stale = true;
  }

  /** Changes the spline; the next curve is its canonical one. */
  setSpline(choice: SplineChoice): void {
    const { name, built, solver } = checked(() => splineOf(choice));
    this.#choice = { spline: name, params: choice.params };
    if (solver === this.#solver) this.#live.set_spline(built);
    this.#stale = true;
  }

  /**
   * The curve through the knots as they are.
   *
   * Throws a {@link FaircurveError} where the knots have no meaning, such as one that isn't a number; the next
   * curve still follows the last good one.
   */
  get curve(): Curve {
    this.solve();
    return (this.#curve ??= new Curve(this.#live.solved(), this.#choice.spline, this.#closed));
  }

  /**
   * Brings the curve up to date now.
   * @param effort how far to search where the curve can't be followed: 1 is at most about 50 ms; left out: about 1 ms
   */
  solve(effort = NaN): void {
    if (!this.#stale) return;
    this.#renew((live) => live.solve(effort));
  }

  /** Gives up the branch for the canonical curve: when the hand lets go. */
  settle(): void {
    this.#renew((live) => live.settle());
  }

  /** The curve as Béziers; the cost is that of what has moved since they were last asked for with this accuracy. */
  beziers(accuracy = 0.1): Beziers {
    this.solve();
    return new Beziers(this.#live.path(accuracy));
  }

  /** The contour and its curve as they are now. */
  snapshot(): Snapshot {
    return new Snapshot({
      live: this.#live.snapshot(),
      solver: this.#solver,
      knots: this.#knots.slice(),
      closed: this.#closed,
      choice: this.#choice,
    });
  }

  /** Comes back to a snapshot, to the bit; as often as you like. */
  restore(snapshot: Snapshot): void {
    const { state } = snapshot;
    this.#live.free();
    this.#live = state.live.snapshot();
    this.#solver = state.solver;
    this.#knots = state.knots.slice();
    this.#closed = state.closed;
    this.#choice = state.choice;
    // Whether the curve was up to date is not known; solving again from itself costs little.
    this.#renewed();
    this.#stale = true;
  }

  /** Gives its memory back now, not when the collector comes by. It can't be used any more. */
  free(): void {
    this.#live.free();
  }

  /** Solves with what there is; from anew where the spline is another module's. */
  #renew(solve: (live: wasm.Live) => void): void {
    const solver = solverOf(this.#choice.spline);
    if (solver === this.#solver) {
      checked(() => solve(this.#live));
    } else {
      const live = checked(() => new solver.Live(splineOf(this.#choice).built, knotRows(this.#knots), this.#closed));
      this.#live.free();
      [this.#live, this.#solver] = [live, solver];
    }
    this.#renewed();
  }

  #renewed(): void {
    this.#stale = false;
    this.#curve = undefined;
  }

  #knot(index: number): Knot {
    const knot = this.#knots[index];
    if (knot === undefined) throw this.#noSuchKnot(index);
    return knot;
  }

  #noSuchKnot(index: number): FaircurveError {
    return new FaircurveError(`there is no knot ${index}`, `the contour has ${this.#knots.length}, counted from 0`);
  }
}

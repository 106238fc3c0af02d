import { FaircurveError } from "./error.js";

type Point = { x: number; y: number };

/** k₀ … k₃ of thesis eq. 8.1 for arc length 1, from −½ to ½: θ(s) = k₀s + k₁s²/2 + k₂s³/6 + k₃s⁴/24. */
export type SpiroK = [number, number, number, number];

/** Half of Gauss's eight nodes on [−1, 1], and their weights. */
const NODES = [0.1834346424956498, 0.525532409916329, 0.7966664774136267, 0.9602898564975363];
const WEIGHTS = [0.362683783378362, 0.31370664587788727, 0.22238103445337448, 0.10122853629037626];

/**
 * A piece of a polynomial spiral between two points, with the members of npm's `spiro`. `at` runs from 0 to 1 in equal
 * steps of arc length.
 */
export class SpiroArc {
  readonly #k: SpiroK;
  /** Of the chord, less that which it has where the middle of the arc goes along x. */
  readonly #turned: number;
  readonly x0: number;
  readonly y0: number;
  readonly x1: number;
  readonly y1: number;
  readonly arcLength: number;
  /** A bound of how far any part of the arc turns from its middle to an end and back, in radians: |k₀| + |k₁|/2 + |k₂|/8 + |k₃|/48. */
  readonly bend: number;
  /** The derivative by `at` at the ends. */
  readonly deriveX0: number;
  readonly deriveY0: number;
  readonly deriveX1: number;
  readonly deriveY1: number;

  /** @throws {@link FaircurveError} where no such spiral leads from the one point to the other. */
  constructor(ks: SpiroK, x0: number, y0: number, x1: number, y1: number) {
    [this.#k, this.x0, this.y0, this.x1, this.y1] = [ks, x0, y0, x1, y1];
    const [k0, k1, k2, k3] = ks.map(Math.abs) as SpiroK;
    this.bend = k0 + k1 / 2 + k2 / 8 + k3 / 48;
    const whole = this.#integral(-0.5, 0.5);
    const [chord, size] = [Math.hypot(x1 - x0, y1 - y0), Math.hypot(whole.x, whole.y)];
    this.arcLength = chord === 0 ? 0 : chord / size;
    this.#turned = Math.atan2(y1 - y0, x1 - x0) - Math.atan2(whole.y, whole.x);
    if (!Number.isFinite(this.arcLength + this.#turned + this.bend)) {
      throw new FaircurveError(
        `no spiral with k = ${ks.join(", ")} leads from (${x0}, ${y0}) to (${x1}, ${y1})`,
        "give finite numbers, and no closed spiral between two points",
      );
    }
    ({ x: this.deriveX0, y: this.deriveY0 } = this.derivative(0));
    ({ x: this.deriveX1, y: this.deriveY1 } = this.derivative(1));
  }

  /** Whether it is a straight line. */
  get isStraight(): boolean {
    return this.bend === 0;
  }

  /** The point; exactly the ends at 0 and 1. */
  eval(at: number): Point {
    const [from, x, y] = at < 0.5 ? [-0.5, this.x0, this.y0] : [0.5, this.x1, this.y1];
    const way = this.#placed(this.#integral(from, at - 0.5));
    return { x: x + way.x, y: y + way.y };
  }

  /** The derivative of the point by `at`: as long as the arc. */
  derivative(at: number): Point {
    const angle = this.#angle(at - 0.5);
    return this.#placed({ x: Math.cos(angle), y: Math.sin(angle) });
  }

  /** What lies before and after a place. */
  subdivide(at: number): [SpiroArc, SpiroArc] {
    const { x, y } = this.eval(at);
    const before = new SpiroArc(this.#part(0, at), this.x0, this.y0, x, y);
    return [before, new SpiroArc(this.#part(at, 1), x, y, this.x1, this.y1)];
  }

  /** The cubic with the same ends and derivatives there; near only where the arc turns little. */
  toCubicBezier(): [Point, Point, Point, Point] {
    const { x0, y0, x1, y1 } = this;
    return [
      { x: x0, y: y0 },
      { x: x0 + this.deriveX0 / 3, y: y0 + this.deriveY0 / 3 },
      { x: x1 - this.deriveX1 / 3, y: y1 - this.deriveY1 / 3 },
      { x: x1, y: y1 },
    ];
  }

  /** From the frame of the middle at arc length 1 to the drawing. */
  #placed({ x, y }: Point): Point {
    const [cos, sin] = [Math.cos(this.#turned), Math.sin(this.#turned)].map((f) => f * this.arcLength);
    return { x: cos! * x - sin! * y, y: sin! * x + cos! * y };
  }

  #angle(s: number): number {
    const [k0, k1, k2, k3] = this.#k;
    return s * (k0 + s * (k1 / 2 + s * (k2 / 6 + (s * k3) / 24)));
  }

  /** ∫ (cos θ, sin θ) ds, to rounding: panels turn by about a radian at most. */
  #integral(from: number, to: number): Point {
    const MOST_PANELS = 10_000;
    const panels = Math.ceil(Math.min(1 + 2 * this.bend, MOST_PANELS));
    const half = (to - from) / panels / 2;
    const sum = { x: 0, y: 0 };
    for (let panel = 0; panel < panels; panel++) {
      const middle = from + half * (2 * panel + 1);
      NODES.forEach((node, i) => {
        for (const s of [middle - half * node, middle + half * node]) {
          sum.x += half * WEIGHTS[i]! * Math.cos(this.#angle(s));
          sum.y += half * WEIGHTS[i]! * Math.sin(this.#angle(s));
        }
      });
    }
    return sum;
  }

  /** k₀ … k₃ of a part, scaled to arc length 1 (eq. 8.3). */
  #part(from: number, to: number): SpiroK {
    const [k0, k1, k2, k3] = this.#k;
    const [s, w] = [(from + to) / 2 - 0.5, to - from];
    return [
      w * (k0 + s * (k1 + s * (k2 / 2 + (s * k3) / 6))),
      w ** 2 * (k1 + s * (k2 + (s * k3) / 2)),
      w ** 3 * (k2 + s * k3),
      w ** 4 * k3,
    ];
  }
}

/** What a path is played onto: the methods of `CanvasRenderingContext2D`, `Path2D` and d3's paths that are called. */
export interface PathContext {
  moveTo(x: number, y: number): void;
  lineTo(x: number, y: number): void;
  quadraticCurveTo(x1: number, y1: number, x: number, y: number): void;
  bezierCurveTo(x1: number, y1: number, x2: number, y2: number, x: number, y: number): void;
  closePath(): void;
}

/** How many numbers follow each command: move, line, quadratic, cubic, close. */
const NUMBERS = [2, 2, 4, 6, 0] as const;
const LETTERS = ["M", "L", "Q", "C", "Z"] as const;

/** A curve as straight lines and Béziers. Every number is finite. */
export class Beziers {
  /**
   * The commands, each followed by its numbers: 0 move (x, y), 1 line (x, y), 2 quadratic (x1, y1, x, y), 3 cubic
   * (x1, y1, x2, y2, x, y), 4 close.
   */
  readonly data: Float64Array;

  constructor(data: Float64Array) {
    this.data = data;
  }

  /** Path data as in the attribute `d` of SVG; numbers read back the same. Empty for an empty curve. */
  toSVG(): string {
    const { data } = this;
    let path = "";
    for (let i = 0; i < data.length; ) {
      const command = data[i]!;
      const end = i + 1 + NUMBERS[command]!;
      path += LETTERS[command];
      for (i += 1; i < end; i += 2) path += `${data[i]},${data[i + 1]}${i + 2 < end ? " " : ""}`;
    }
    return path;
  }

  /** The path for a canvas. Where there is no `Path2D`, as in Node, a `ReferenceError`. */
  toPath2D(): Path2D {
    const path = new Path2D();
    this.draw(path);
    return path;
  }

  /**
   * Calls the methods of a context, one for each command.
   * @param from the command to start with; 1 leaves the first move out, to go on with a path
   */
  draw(context: PathContext, from = 0): void {
    const { data: d } = this;
    let count = 0;
    for (let i = 0; i < d.length; i += 1 + NUMBERS[d[i]!]!, count++) {
      if (count < from) continue;
      switch (d[i]) {
        case 0:
          context.moveTo(d[i + 1]!, d[i + 2]!);
          break;
        case 1:
          context.lineTo(d[i + 1]!, d[i + 2]!);
          break;
        case 2:
          context.quadraticCurveTo(d[i + 1]!, d[i + 2]!, d[i + 3]!, d[i + 4]!);
          break;
        case 3:
          context.bezierCurveTo(d[i + 1]!, d[i + 2]!, d[i + 3]!, d[i + 4]!, d[i + 5]!, d[i + 6]!);
          break;
        default:
          context.closePath();
      }
    }
  }
}

/** What Béziers are asked for. */
export interface BezierOptions {
  /** The largest distance from the curve, in the drawing's units; left out: 1/10000 of its larger side. */
  accuracy?: number;
  /** How errors are measured; `distance` if left out. */
  metric?: "distance" | "abs-angle" | "sq-angle";
  /** How one cubic is fitted; `optimal` if left out. */
  fit?: "optimal" | "arc-third" | "equal-arms" | "end-curvature";
  /** Where the curve is cut; `greedy` (the fewest) if left out. */
  cuts?: "greedy" | "equal-errors" | "balanced" | "halving" | "halving-bend";
  /** Whether to cut where the tangent is horizontal or vertical, as outline fonts want it. */
  atExtrema?: boolean;
  /** Whether to cut where the curvature changes its sign. */
  atInflections?: boolean;
  /** Whether a cubic may run through knots at which the curve is smooth. */
  spanKnots?: boolean;
  /** Whether joints may lie beside the curve, within the accuracy, where that saves cubics. */
  freeJoints?: boolean;
}

/** Béziers, and how near to the curve they are. */
export class Conversion extends Beziers {
  /** An upper bound of the distance from the curve, proved, in the drawing's units. */
  readonly bound: number;
  /** The largest error of a cubic in the metric's units. */
  readonly error: number;
  readonly cubics: number;
  readonly lines: number;
  readonly quadratics: number;

  /** @internal */
  constructor(numbers: Float64Array) {
    super(numbers.subarray(5));
    this.bound = numbers[0]!;
    this.error = numbers[1]!;
    this.cubics = numbers[2]!;
    this.lines = numbers[3]!;
    this.quadratics = numbers[4]!;
  }
}

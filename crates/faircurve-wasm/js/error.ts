/** What is wrong with the input, in the words that the program `faircurve` has for it. */
export class FaircurveError extends Error {
  /** What to do about it; empty where there is nothing to say. */
  readonly hint: string;
  /** Where in the file, for errors of readers. */
  readonly location: Location | undefined;

  /** Any error of that name: each of the package's scripts has its own copy of this class. */
  static override [Symbol.hasInstance](error: unknown): boolean {
    return error instanceof Error && error.name === "FaircurveError";
  }

  constructor(message: string, hint = "", location?: Location) {
    super(message);
    this.name = "FaircurveError";
    this.hint = hint;
    this.location = location;
  }
}

/** A stretch of a file. */
export interface Location {
  /** Counted from 1. */
  line: number;
  /** In characters, counted from 1. */
  column: number;
  /** Where the offending token starts: bytes from the start of the file. */
  offset: number;
  /** The offending token's length in bytes; 0 where something is missing. */
  length: number;
}

/** Does it, and turns errors of the module into those of the package; `place` starts their messages. */
export function checked<T>(does: () => T, place?: () => string): T {
  try {
    return does();
  } catch (error) {
    if (error instanceof Error && "hint" in error && !(error instanceof FaircurveError)) {
      const { message, hint, location } = error as Error & { hint: string; location?: Location };
      throw new FaircurveError(place ? `${place()}: ${message}` : message, hint, location);
    }
    throw error;
  }
}

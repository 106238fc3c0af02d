// Whether there is a drawing to begin with, told without loading anything.

/** Of the drawing that the browser keeps. */
export const STORE = "faircurve.drawing";

/** @param {Location} location */
export function isWaiting({ hash, search }) {
  try {
    return hash !== "" || search !== "" || localStorage.getItem(STORE) !== null;
  } catch {
    return false;
  }
}

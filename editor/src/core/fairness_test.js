// The test of thesis 2.1.1: which exponent α of κ = c·sᵅ draws the fairest curve? Variants in random order and
// without names; what was picked is kept and summed up as in figure 2.2.

/** The exponents that are shown, from MEC-like to tight. @type {readonly number[]} */
export const EXPONENTS = [0.3, 0.6, 0.9, 1.2, 1.5, 1.8, 2.1, 2.5, 3];

/** @typedef {{alpha: number, at: string}} Answer */

/** The exponents in random order. @param {() => number} [random] */
export function shuffled(random = Math.random) {
  const order = [...EXPONENTS];
  for (let i = order.length - 1; i > 0; i--) {
    const j = Math.floor(random() * (i + 1));
    [order[i], order[j]] = [order[j], order[i]];
  }
  return order;
}

/** How often each exponent was picked, and the mean of all picks. @param {readonly Answer[]} answers */
export function summed(answers) {
  const known = answers.filter(({ alpha }) => EXPONENTS.includes(alpha));
  const votes = EXPONENTS.map((alpha) => ({ alpha, count: known.filter((answer) => answer.alpha === alpha).length }));
  const mean = known.length ? known.reduce((sum, { alpha }) => sum + alpha, 0) / known.length : null;
  return { votes, count: known.length, mean };
}

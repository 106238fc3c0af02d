// The contours that are measured.

/** Numbers in [−1, 1), the same in every run. */
export function randomNumbers(seed) {
  let state = seed;
  return () => (state = (state * 48271) % 2147483647) / 1073741823.5 - 1;
}

/** A closed outline with five waves, each knot moved along and across it by up to a tenth of their spacing. */
export function outline(count, seed = 1) {
  const random = randomNumbers(seed);
  const spacing = (2 * Math.PI) / count;
  return Array.from({ length: count }, (_, i) => {
    const angle = spacing * (i + 0.1 * random());
    const radius = 500 * (1 + 0.15 * Math.sin(5 * angle) + 0.1 * spacing * random());
    return { x: radius * Math.cos(angle), y: radius * Math.sin(angle) };
  });
}

/** The middle of the times. */
export const median = (times) => quantile(times, 0.5);

export function quantile(times, share) {
  const sorted = [...times].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
}

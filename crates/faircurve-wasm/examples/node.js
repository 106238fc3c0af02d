// Reads a drawing, solves it, prints what a designer asks about, and writes an SVG.
//   node node.js a.json a.svg
import { readFile, writeFile } from "node:fs/promises";
import { basename } from "node:path";
import { FaircurveError, solve } from "faircurve";
import { read, svg } from "faircurve/formats";

const [input, output] = process.argv.slice(2);
try {
  const document = read(await readFile(input), basename(input));
  for (const curve of solve(document).contours) {
    const { inflections, scaleFreeEnergy } = curve.measures();
    console.log(
      `${curve.spline}: ${curve.status}, length ${curve.length.toFixed(1)}, ${inflections} inflections,`,
      `energy ${scaleFreeEnergy.toFixed(1)}`,
    );
    for (const { knot, asked, got, reason } of curve.relaxed) console.log(`  knot ${knot}: ${asked} → ${got}: ${reason}`);
  }
  if (output) await writeFile(output, svg(document, { knots: true, comb: true }));
} catch (error) {
  if (!(error instanceof FaircurveError)) throw error;
  console.error(`error: ${error.message}`);
  if (error.hint) console.error(`hint: ${error.hint}`);
  process.exitCode = 2;
}

// The package as a stranger has it: packed by npm, installed into an empty folder, used from there.
import { execFileSync } from "node:child_process";
import { cpSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

export const root = fileURLToPath(new URL("../../..", import.meta.url));
const source = fileURLToPath(new URL("..", import.meta.url));
const built = process.env.FAIRCURVE_PACKAGE ?? join(root, "target/npm");

/** Calls `use` with a folder in which the package is installed, with copies of `folders` of the crate in it. */
export async function asStranger(folders, use) {
  const folder = mkdtempSync(join(tmpdir(), "faircurve-"));
  const npm = (...words) => execFileSync("npm", words, { cwd: folder, encoding: "utf8", stdio: ["ignore", "pipe", "inherit"] });
  try {
    writeFileSync(join(folder, "package.json"), '{ "private": true, "type": "module" }\n');
    const packed = npm("pack", resolve(built), "--silent").trim();
    npm("install", "--no-audit", "--no-fund", "--silent", `./${packed}`);
    // The others that tests and measurements need, as this folder's lock file has them.
    for (const other of ["d3-shape", "d3-path", "spiro", "tslib", "playwright-core"]) {
      cpSync(join(source, "node_modules", other), join(folder, "node_modules", other), { recursive: true });
    }
    for (const name of folders) cpSync(join(source, name), join(folder, name), { recursive: true });
    return await use(folder);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

/** Runs Node there, with its output on ours; its exit code. */
export function node(folder, words) {
  try {
    execFileSync("node", words, { cwd: folder, stdio: "inherit", env: { ...process.env, FAIRCURVE_ROOT: root } });
    return 0;
  } catch (error) {
    return error.status ?? 1;
  }
}

// The types as a stranger's TypeScript reads them, the package's own files included.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { join } from "node:path";
import { test } from "node:test";

test("a program is checked against the package's types", () => {
  const tsc = join(process.env.FAIRCURVE_ROOT, "crates/faircurve-wasm/node_modules/typescript/bin/tsc");
  const options = ["--strict", "--noEmit", "--module", "nodenext", "--target", "es2022", "--lib", "es2022,dom,esnext.disposable"];
  const { status, stdout } = spawnSync("node", [tsc, ...options, "test/types.ts"], { encoding: "utf8" });
  assert.equal(status, 0, stdout);
});

// npm test: the tests, run from the package as a stranger has it.
import { readdirSync } from "node:fs";
import { join } from "node:path";
import { asStranger, node } from "./stranger.js";

process.exitCode = await asStranger(["test", "examples"], (folder) => {
  const tests = readdirSync(join(folder, "test")).filter((name) => name.endsWith(".test.js"));
  return node(folder, ["--test", ...tests.map((name) => join("test", name))]);
});

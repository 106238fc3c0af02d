// `faircurve edit` with a browser on it. `FAIRCURVE_PROGRAM` names the program.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtemp, readFile, readdir, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { EXAMPLES } from "../src/examples.js";
import { toText } from "../src/core/document.js";
import { launch, open, ready, repository, shot, state } from "./helpers.js";

const PROGRAM = process.env.FAIRCURVE_PROGRAM ?? repository("target/release/faircurve");
const SITE = process.env.FAIRCURVE_SITE ?? repository("target/editor");

/** @type {Awaited<ReturnType<typeof launch>>} */
let browser;
/** @type {string} */
let folder;
before(async () => {
  browser = await launch();
  folder = await mkdtemp(join(tmpdir(), "faircurve-edit-"));
});
after(async () => {
  await browser?.close();
  await rm(folder, { recursive: true, force: true });
});

/** The program on a file, and its address. @param {string[]} files */
async function edit(...files) {
  const program = spawn(PROGRAM, ["edit", "--site", SITE, "--no-browser", ...files], { stdio: ["ignore", "pipe", "ignore"] });
  const address = await new Promise((resolve, reject) => {
    program.stdout.once("data", (data) => resolve(String(data).trim()));
    program.once("exit", () => reject(new Error("the program has ended")));
  });
  return { address, end: () => program.kill() };
}

/** @param {import("playwright-core").Page} page @param {string} words */
const said = (page, words) => page.waitForFunction((words) => document.querySelector("#said")?.textContent?.includes(words), words);

test("a file is opened, changed, saved whole, and nothing else is left behind", async () => {
  const path = join(folder, "a letter.json");
  await writeFile(path, toText(EXAMPLES[0].document));
  const { address, end } = await edit(path);
  const { page, problems, context } = await open(browser, address);
  assert.deepEqual((await state(page)).document, EXAMPLES[0].document);
  assert.equal(await page.locator("#name").textContent(), "a letter.json");
  await page.keyboard.press("n");
  await page.keyboard.press("Shift+ArrowRight");
  await page.waitForFunction(() => document.querySelector("#name")?.textContent?.endsWith("•"));
  await shot(page, "edit");
  await page.keyboard.press("Control+s");
  await said(page, "is saved");
  const { glyphs } = JSON.parse(await readFile(path, "utf8"));
  assert.equal(glyphs[0].contours[0].knots[0].x, 56);
  assert.deepEqual(await readdir(folder), ["a letter.json"]);
  await page.reload();
  await ready(page);
  assert.equal((await state(page)).contours[0].knots[0].x, 56);
  assert.deepEqual(problems, []);

  // Something else writes the file: the next save asks.
  await page.keyboard.press("n");
  await page.keyboard.press("Shift+ArrowRight");
  const other = toText(EXAMPLES[2].document);
  await writeFile(path, other);
  await page.keyboard.press("Control+s");
  await page.getByRole("heading", { name: "has changed on disk" }).waitFor();
  await shot(page, "changed-on-disk");
  await page.getByRole("button", { name: "Neither" }).click();
  assert.equal(await readFile(path, "utf8"), other);
  await page.keyboard.press("Control+s");
  await page.getByRole("button", { name: "Open what is on disk" }).click();
  await page.waitForFunction(() => /** @type {any} */ (globalThis).faircurveEditor.editor.contours.length === 1);
  assert.deepEqual((await state(page)).document, EXAMPLES[2].document);
  await page.keyboard.press("Control+z");
  assert.equal((await state(page)).contours.length, 2, "opening can be undone");
  await page.keyboard.press("Control+s");
  await said(page, "is saved");
  assert.equal(JSON.parse(await readFile(path, "utf8")).glyphs[0].contours.length, 2);
  await context.close();
  end();
});

test("a new file is made by the first save; a font is opened and not written", async () => {
  const path = join(folder, "new.json");
  let { address, end } = await edit(path);
  const first = await open(browser, address);
  await first.page.getByRole("button", { name: "A road" }).waitFor();
  await first.page.mouse.click(300, 300);
  await first.page.mouse.click(500, 350);
  await first.page.keyboard.press("Control+s");
  await said(first.page, "is saved");
  assert.equal(JSON.parse(await readFile(path, "utf8")).glyphs[0].contours[0].knots.length, 2);
  await first.context.close();
  end();

  const font = join(folder, "comma.sfd");
  const before = await readFile(repository("examples/comma.sfd"));
  await writeFile(font, before);
  ({ address, end } = await edit(font));
  const { page, context } = await open(browser, address);
  assert.ok((await state(page)).contours.length > 0);
  await page.keyboard.press("Control+s");
  await page.getByText("can be read, but not written").waitFor();
  assert.deepEqual(await readFile(font), before);
  await context.close();
  end();
});

test("another page can neither read nor write the file", async () => {
  const path = join(folder, "mine.json");
  await writeFile(path, toText(EXAMPLES[0].document));
  const { address, end } = await edit(path);
  const api = new URL("api/file", address).href;
  const context = await browser.newContext();
  const page = await context.newPage();
  // A page of another origin, with the token even.
  const other = await edit();
  await page.goto(other.address);
  const token = new URL(address).searchParams.get("token");
  const answers = await page.evaluate(async ([api, token]) => {
    const ask = (/** @type {RequestInit} */ options) => fetch(api, options).then((answer) => `answered ${answer.status} ${answer.type}`, () => "blocked");
    return [
      await ask({}),
      await ask({ headers: { "X-Faircurve-Token": token } }),
      await ask({ method: "PUT", headers: { "X-Faircurve-Token": token, "If-Match": "*" }, body: "{}" }),
      await ask({ method: "POST", mode: "no-cors", body: "{}" }),
    ];
  }, /** @type {[string, string]} */ ([api, token]));
  assert.deepEqual(answers.slice(0, 3), ["blocked", "blocked", "blocked"]);
  assert.equal(await readFile(path, "utf8"), toText(EXAMPLES[0].document));
  await context.close();
  end();
  other.end();
});

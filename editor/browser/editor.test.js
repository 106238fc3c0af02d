// What a designer does, in a real browser with real pointers and keys.

import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { after, before, test } from "node:test";
import axe from "axe-core";
import { at, choose, click, curves, downloaded, drag, launch, open, ready, repository, serve, shot, state } from "./helpers.js";
import { letters } from "./letters.js";

/** @type {Awaited<ReturnType<typeof launch>>} */
let browser;
/** @type {Awaited<ReturnType<typeof serve>>} */
let site;
before(async () => {
  browser = await launch();
  site = await serve();
});
after(async () => {
  await browser?.close();
  site?.close();
});

const KEYS = /** @type {Record<string, string>} */ ({ "corner": "1", "g2": "2", "g4": "3", "curve-to-terminal": "4", "terminal-to-curve": "5", "g1": "6" });

for (const name of /** @type {const} */ (["a", "g", "s"])) {
  test(`the letter ${name} is drawn from the empty page and saved`, async () => {
    const contours = (await letters())[name];
    const { page, problems, context } = await open(browser, site.url);
    await shot(page, "empty");
    // Coordinates are the letter's, not those of neighbours.
    for (const chip of ["Knots", "Axes"]) await page.getByRole("group", { name: "Snap to" }).getByRole("button", { name: chip }).click();
    for (const { knots } of contours) {
      for (const [i, { x, y, join }] of knots.entries()) {
        await click(page, x, y, join === "corner" ? ["Shift"] : []);
        if (i === 3) await shot(page, `${name}-drawing`);
      }
      await click(page, knots[0].x, knots[0].y);
    }
    await page.keyboard.press("v");
    for (const { knots } of contours) {
      for (const { x, y, join } of knots) {
        if (!join || join === "corner" || join === "g4") continue;
        await click(page, x, y);
        await page.keyboard.press(KEYS[join]);
      }
    }
    await page.keyboard.press("Escape");
    const saved = JSON.parse((await downloaded(page, () => page.keyboard.press("Control+s"))).text);
    assert.equal(saved.faircurve, 1);
    assert.equal(saved.glyphs[0].contours.length, contours.length);
    for (const [c, { closed, knots }] of contours.entries()) {
      const drawn = saved.glyphs[0].contours[c];
      assert.equal(drawn.closed, closed);
      assert.equal(drawn.knots.length, knots.length, `contour ${c}`);
      for (const [k, knot] of knots.entries()) {
        const { x, y, join = "g4" } = drawn.knots[k];
        assert.ok(Math.abs(x - knot.x) <= 2 && Math.abs(y - knot.y) <= 2, `contour ${c}, knot ${k}: ${x}, ${y} for ${knot.x}, ${knot.y}`);
        assert.equal(join, knot.join, `contour ${c}, knot ${k}`);
      }
    }
    assert.deepEqual((await curves(page)).map(({ relaxed }) => relaxed), contours.map(() => []));
    await page.keyboard.press("c");
    await page.keyboard.press("Control+0");
    await shot(page, `letter-${name}`);
    assert.deepEqual(problems, []);
    await context.close();
  });
}

test("a glyph of a font is opened, dragged, undone, redone, compared, exported, and found again after a reload", async (t) => {
  const font = repository("../shared/data/Chomsky.sfd");
  const isFont = existsSync(font);
  if (!isFont) t.diagnostic("without ../shared/data: examples/comma.sfd in place of Chomsky");
  const { page, problems, context } = await open(browser, site.url);
  await choose(page, () => page.keyboard.press("Control+o"), isFont ? font : repository("examples/comma.sfd"));
  await page.waitForFunction(() => document.querySelector("#name")?.textContent?.endsWith(".sfd"));
  if (isFont) {
    await page.getByLabel("Glyph").selectOption({ label: "M" });
    assert.equal((await state(page)).contours.flatMap(({ knots }) => knots).length, 242);
  }
  await shot(page, "font-glyph");
  const first = await state(page);
  const knot = first.contours[0].knots[2];
  await drag(page, [knot.x, knot.y], [knot.x + 40, knot.y + 25]);
  const dragged = await state(page);
  assert.notDeepEqual(dragged.contours, first.contours);
  await page.keyboard.press("Control+z");
  assert.deepEqual((await state(page)).contours, first.contours);
  await page.keyboard.press("Control+Shift+Z");
  assert.deepEqual((await state(page)).contours, dragged.contours);

  await page.keyboard.press("s");
  const chips = page.getByRole("group", { name: "Splines to compare" });
  await chips.getByRole("button", { name: "log-aesthetic" }).click();
  const rows = page.locator("#compare tbody tr");
  assert.deepEqual(await rows.locator("th").allTextContents(), ["spiro (drawing)", "euler", "hobby", "log-aesthetic"]);
  await page.getByLabel("the power with which curvature rises").fill("3");
  await page.waitForFunction(() => document.querySelector("#compare output")?.textContent);
  await shot(page, "compared");
  await page.getByRole("button", { name: "Side by side" }).click();
  assert.equal(await page.locator("dialog figure").count(), 4);
  await shot(page, "side-by-side");
  await page.keyboard.press("Escape");
  await page.getByRole("button", { name: "Close the comparison" }).click();

  const svg = await downloaded(page, () => page.keyboard.press("Control+e"));
  assert.match(svg.name, /\.svg$/);
  assert.match(svg.text, /<path[^>]* d="M/);
  const json = await downloaded(page, () => page.keyboard.press("Control+s"));
  assert.deepEqual(JSON.parse(json.text).glyphs, dragged.document.glyphs);
  await page.keyboard.press("Control+Shift+C");
  await page.waitForFunction(() => document.querySelector("#said")?.textContent?.includes("clipboard"));
  assert.match(await page.evaluate(() => navigator.clipboard.readText()), /^M[-\d.]/);

  await page.reload();
  await ready(page);
  const again = await state(page);
  assert.deepEqual(again.document, dragged.document);
  assert.equal(again.glyph, dragged.glyph);
  assert.deepEqual(problems, []);
  await context.close();
});

test("a link opens the drawing in a fresh profile", async () => {
  const { page, context } = await open(browser, site.url);
  await page.getByRole("button", { name: "A letter" }).click();
  await page.keyboard.press("Control+l");
  await page.waitForFunction(() => document.querySelector("#said")?.textContent?.includes("link"));
  const link = await page.evaluate(() => navigator.clipboard.readText());
  const shared = (await state(page)).document;
  await context.close();
  assert.ok(link.length < 1200, `${link.length} characters`);
  const fresh = await open(browser, link);
  assert.deepEqual((await state(fresh.page)).document, shared);
  assert.ok(!fresh.page.url().includes("#"), "a reload must not undo later work");
  assert.deepEqual(fresh.problems, []);
  await fresh.page.goto(`${link.slice(0, -20)}`);
  await fresh.page.getByText("the link's drawing is damaged").waitFor();
  await fresh.context.close();
});

test("everything by keyboard: draw, close, select, change, move, menu, save", async () => {
  const { page, problems, context } = await open(browser, site.url);
  await page.keyboard.press("p");
  const go = async (/** @type {string} */ key, /** @type {number} */ times) => {
    for (let i = 0; i < times; i++) await page.keyboard.press(key);
  };
  await go("ArrowRight", 1);
  const [x0, y0] = await page.evaluate(() => (document.querySelector("#said")?.textContent ?? "").match(/-?[\d.]+/g)?.map(Number) ?? []);
  await page.keyboard.press("Enter");
  await go("Shift+ArrowRight", 2);
  await page.keyboard.press("Shift+Enter");
  await go("Shift+ArrowUp", 2);
  await page.keyboard.press("Enter");
  await go("Shift+ArrowLeft", 2);
  await go("ArrowLeft", 3);
  await shot(page, "keyboard");
  await page.keyboard.press("Enter");
  await go("Shift+ArrowDown", 2);
  await go("ArrowRight", 3);
  await page.keyboard.press("Enter");
  const drawn = (await state(page)).contours;
  assert.deepEqual(drawn, [{
    closed: true,
    knots: [{ x: x0, y: y0 }, { x: x0 + 200, y: y0, join: "corner" }, { x: x0 + 200, y: y0 + 200 }, { x: x0 - 30, y: y0 + 200 }],
  }]);
  await page.keyboard.press("v");
  await page.keyboard.press("n");
  await page.keyboard.press("n");
  await page.keyboard.press("2");
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("Shift+ArrowUp");
  await page.keyboard.press("Alt+ArrowUp");
  assert.deepEqual((await state(page)).contours[0].knots[1], { x: x0 + 199, y: y0 + 10.1, join: "g2" });
  // The menus, from the bar.
  await page.getByRole("button", { name: "View", exact: true }).focus();
  await page.keyboard.press("Enter");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("Enter");
  assert.ok(await page.evaluate(() => /** @type {any} */ (globalThis).faircurveEditor.settings.values.layers.comb));
  await page.keyboard.press("?");
  await page.getByRole("heading", { name: "All keys" }).waitFor();
  await shot(page, "keys");
  await page.keyboard.press("Escape");
  // Every part can be reached with Tab, and is seen to be.
  const reached = new Set();
  for (let i = 0; i < 60; i++) {
    await page.keyboard.press("Tab");
    reached.add(await page.evaluate(() => document.activeElement?.closest("#bar, #rail, #stage, #inspector")?.id));
  }
  for (const part of ["bar", "rail", "stage", "inspector"]) assert.ok(reached.has(part), `Tab doesn't reach ${part}`);
  const saved = await downloaded(page, () => page.keyboard.press("Control+s"));
  assert.equal(JSON.parse(saved.text).glyphs[0].contours[0].knots.length, 4);
  assert.deepEqual(problems, []);
  await context.close();
});

test("fingers draw, drag, pan and zoom", async () => {
  const { page, problems, context } = await open(browser, site.url, { hasTouch: true, isMobile: true, viewport: { width: 600, height: 900 } });
  for (const [x, y] of [[100, 100], [400, 60], [450, 400], [150, 450]]) {
    await page.touchscreen.tap(...(await at(page, x, y)));
  }
  await page.touchscreen.tap(...(await at(page, 100, 100)));
  let { contours } = await state(page);
  assert.equal(contours.length, 1);
  assert.deepEqual([contours[0].closed, contours[0].knots.length], [true, 4]);
  await page.getByRole("button", { name: "Select", exact: true }).tap();
  const cdp = await context.newCDPSession(page);
  const touch = (/** @type {"touchStart" | "touchMove" | "touchEnd"} */ type, /** @type {number[][]} */ ...points) =>
    cdp.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  const knot = contours[0].knots[2];
  const [from, to] = [await at(page, knot.x, knot.y), await at(page, knot.x + 60, knot.y + 40)];
  await touch("touchStart", from);
  for (let i = 1; i <= 6; i++) await touch("touchMove", [from[0] + ((to[0] - from[0]) * i) / 6, from[1] + ((to[1] - from[1]) * i) / 6]);
  await touch("touchEnd");
  ({ contours } = await state(page));
  assert.ok(Math.abs(contours[0].knots[2].x - knot.x - 60) <= 12, `${contours[0].knots[2].x}`);
  const scale = () => page.evaluate(() => /** @type {any} */ (globalThis).faircurveEditor.stage.viewport.scale);
  const before = await scale();
  await touch("touchStart", [250, 300], [350, 300]);
  for (let i = 1; i <= 6; i++) await touch("touchMove", [250 - 10 * i, 300], [350 + 10 * i, 300]);
  await touch("touchEnd");
  assert.ok((await scale()) > 1.8 * before, "pinching zooms");
  assert.deepEqual((await state(page)).contours, contours, "pinching draws nothing");
  await shot(page, "touch");
  assert.deepEqual(problems, []);
  await context.close();
});

test("a damaged file is refused with its place, and nothing is lost", async () => {
  const { page, context } = await open(browser, site.url);
  await page.getByRole("button", { name: "A letter" }).click();
  const { document } = await state(page);
  const damaged = '{"faircurve": 1, "contours": [{"knots": [\n  {"x": 0, "y": 0, "joyn": "g4"}]}]}';
  await choose(page, () => page.keyboard.press("Control+o"), { name: "bad.json", mimeType: "application/json", buffer: Buffer.from(damaged) });
  const dialog = page.getByRole("dialog");
  await dialog.getByText("there is no key `joyn` here").waitFor();
  assert.match(await dialog.textContent() ?? "", /bad\.json:2:\d+.*hint: did you mean `join`/s);
  await shot(page, "damaged");
  await page.keyboard.press("Escape");
  assert.deepEqual((await state(page)).document, document);
  for (const [name, bytes] of /** @type {[string, Buffer][]} */ ([["half.sfd", Buffer.from("SplineFontDB: 3.0\nBegin")], ["noise.json", Buffer.from([0xff, 0xfe, 0, 1, 2])], ["what.xyz", Buffer.from("?")]])) {
    await choose(page, () => page.keyboard.press("Control+o"), { name, mimeType: "application/octet-stream", buffer: bytes });
    await page.waitForTimeout(100);
    if (await page.getByRole("dialog").count()) await page.keyboard.press("Escape");
    else await page.keyboard.press("Control+z");
    assert.deepEqual((await state(page)).document, document, name);
  }
  await context.close();
});

test("comb, extrema, Béziers, plot and numbers show what the curve has", async () => {
  const { page, problems, context } = await open(browser, site.url);
  await page.getByRole("button", { name: "A letter" }).click();
  await page.keyboard.press("c");
  /** How many pixels of a canvas have a colour of the style sheet. */
  const pixels = (/** @type {string} */ name, selector = "#canvas") => page.evaluate(async ([name, selector]) => {
    await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
    const canvas = /** @type {HTMLCanvasElement} */ (document.querySelector(selector));
    const colour = getComputedStyle(canvas).getPropertyValue(`--canvas-${name}`).trim();
    const [r, g, b] = [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16));
    const { data } = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d")).getImageData(0, 0, canvas.width, canvas.height);
    let count = 0;
    for (let i = 0; i < data.length; i += 4) if (Math.abs(data[i] - r) + Math.abs(data[i + 1] - g) + Math.abs(data[i + 2] - b) < 60) count++;
    return count;
  }, [name, selector]);
  for (const [key, colour] of [["c", "comb"], ["e", "extremum"], ["b", "bezier"]]) {
    const before = await pixels(colour);
    await page.keyboard.press(key);
    const after = await pixels(colour);
    assert.ok(after > before + 40, `${colour}: ${before}, then ${after}`);
  }
  const small = await pixels("comb");
  await page.getByLabel("Length of the comb").fill("140");
  assert.ok((await pixels("comb")) !== small, "the comb has an amplitude");
  await page.keyboard.press("u");
  assert.ok((await pixels("comb", "#plot canvas")) > 200, "the plot shows a curve");
  const row = async (/** @type {string} */ caption, /** @type {string} */ name) =>
    (await page.locator("table.numbers", { hasText: caption }).getByRole("row", { name }).first().locator("td").allTextContents());
  await click(page, 236, 512);
  assert.equal((await row("Continuity", "κ″")).at(-1), "none");
  await click(page, 333, 68);
  assert.notEqual((await row("Continuity", "direction")).at(-1), "none");
  const cubics = async () => Number.parseInt(await page.getByRole("row", { name: "cubics" }).first().locator("td").textContent() ?? "");
  const coarse = await cubics();
  await page.getByLabel("Accuracy of Béziers in units").fill("0.001");
  await page.getByLabel("Accuracy of Béziers in units").press("Enter");
  assert.ok((await cubics()) > coarse, "a finer accuracy needs more cubics");
  assert.deepEqual(problems, []);
  await context.close();
});

test("a file dropped on the page is opened", async () => {
  const { page, problems, context } = await open(browser, site.url);
  await page.evaluate(() => {
    const data = new DataTransfer();
    data.items.add(new File(["0,0\n100,0\n50,80\n"], "three.csv"));
    dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
  });
  await page.waitForFunction(() => document.querySelector("#name")?.textContent === "three.csv");
  assert.equal((await state(page)).contours[0].knots.length, 3);
  await page.keyboard.press("Control+z");
  assert.equal((await state(page)).contours.length, 0);
  assert.deepEqual(problems, []);
  await context.close();
});

test("joins by double click, key and button; the tangent is given, turned and freed", async () => {
  const { page, problems, context } = await open(browser, site.url);
  await page.getByRole("button", { name: "A letter" }).click();
  const double = async (/** @type {number} */ x, /** @type {number} */ y) => page.mouse.dblclick(...(await at(page, x, y)));
  const knot = async (/** @type {number} */ k) => (await state(page)).contours[0].knots[k];
  await double(170, -12);
  assert.equal((await knot(1)).join, "g2");
  await page.waitForTimeout(500);
  await double(170, -12);
  assert.equal((await knot(1)).join, "corner");
  await page.getByRole("button", { name: "smoother (G4)" }).first().click();
  assert.equal((await knot(1)).join, "g4");
  await page.locator("#canvas").focus();
  await page.keyboard.press("t");
  const given = await knot(1);
  assert.ok(given.tangent_in && given.tangent_out);
  assert.deepEqual(given.tangent_in, given.tangent_out);
  await page.getByLabel("leaves at, in degrees").fill("10");
  await page.getByLabel("leaves at, in degrees").press("Enter");
  assert.ok(Math.abs((/** @type {number[]} */ ((await knot(1)).tangent_out)[1]) - Math.sin(Math.PI / 18)) < 1e-6);
  await shot(page, "tangent");
  await page.getByRole("button", { name: "Free the tangent" }).click();
  assert.equal((await knot(1)).tangent_out, undefined);
  await page.getByLabel("x", { exact: true }).fill("160+8");
  await page.getByLabel("x", { exact: true }).press("Enter");
  assert.equal((await knot(1)).x, 168);
  assert.deepEqual(problems, []);
  await context.close();
});

test("curvature, tension and curl are typed in and taken away, and a contour's own parameters are set", async () => {
  const { page, problems, context } = await open(browser, site.url);
  await page.getByRole("button", { name: "A road" }).click();
  const knot = async () => (await state(page)).contours[0].knots[(await state(page)).selected[0].knot];
  const type = async (/** @type {string} */ label, /** @type {string} */ value) => {
    await page.getByLabel(label).fill(value);
    await page.getByLabel(label).press("Enter");
  };
  await page.locator("#canvas").focus();
  await page.keyboard.press("n");
  await page.getByLabel("Spline", { exact: true }).selectOption("euler");
  assert.match(await page.getByLabel("curvature after, in 1/units").getAttribute("placeholder") ?? "", /free/);
  await type("curvature after, in 1/units", "0.0025");
  assert.equal((await knot()).curvature_out, 0.0025);
  await shot(page, "curvature");
  await page.getByLabel("Spline", { exact: true }).selectOption("hobby");
  await type("curl at this end, at least 0", "2");
  await type("tension after, at least 0.75", "1.5");
  assert.equal((await knot()).curl, 2);
  assert.equal((await knot()).tension_out, 1.5);
  // Hobby's spline has no curvatures to give: one that is given stays in sight, and is said to be of no use.
  await page.getByText("hobby takes no curvature here").waitFor();
  await type("curvature after, in 1/units", "");
  assert.equal((await knot()).curvature_out, undefined);
  assert.equal(await page.getByText("hobby takes no curvature here").count(), 0);
  await page.locator("#canvas").focus();
  await page.keyboard.press("Control+z");
  assert.equal((await knot()).curvature_out, 0.0025);
  await page.getByLabel("Spline of this contour").selectOption("mec");
  const penalty = page.locator(".part", { hasText: "Spline" }).getByLabel(/penalty|arc length/i).last();
  await penalty.evaluate((slider) => {
    /** @type {HTMLInputElement} */ (slider).value = "0.5";
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    slider.dispatchEvent(new Event("change", { bubbles: true }));
  });
  assert.equal((await state(page)).contours[0].params?.penalty, 0.5);
  await page.locator("#canvas").focus();
  await page.keyboard.press("Control+z");
  assert.equal((await state(page)).contours[0].params?.penalty, undefined);
  assert.deepEqual(problems, []);
  await context.close();
});

test("a marquee selects, the frame scales and turns, contours are duplicated and mirrored", async () => {
  const { page, problems, context } = await open(browser, site.url);
  await page.getByRole("button", { name: "A logo" }).click();
  await page.mouse.move(...(await at(page, -40, -40)));
  await drag(page, [-40, -40], [640, 640]);
  const all = await state(page);
  assert.equal(all.selected.length, all.contours.flatMap(({ knots }) => knots).length);
  await shot(page, "frame");
  const right = await at(page, 600, 300);
  await page.mouse.move(right[0] + 12, right[1]);
  await page.mouse.down();
  await page.mouse.move(right[0] + 112, right[1], { steps: 5 });
  await page.mouse.up();
  const scaled = (await state(page)).contours.flatMap(({ knots }) => knots.map(({ x }) => x));
  assert.ok(Math.max(...scaled) > 680, `${Math.max(...scaled)}`);
  await page.keyboard.press("Control+z");
  await page.keyboard.press("m");
  assert.equal((await state(page)).contours[2].knots[0].x, 600 - all.contours[2].knots[0].x);
  await page.keyboard.press("Control+d");
  assert.equal((await state(page)).contours.length, 2 * all.contours.length);
  await page.keyboard.press("Control+z");
  await page.keyboard.press("Delete");
  assert.equal((await state(page)).contours.length, 0);
  assert.deepEqual(problems, []);
  await context.close();
});

test("a click on the curve inserts a knot that leaves it where it is; an open contour goes on at either end", async () => {
  const { page, problems, context } = await open(browser, site.url);
  await page.getByRole("button", { name: "A letter" }).click();
  const before = await curves(page);
  await page.keyboard.press("p");
  const on = await page.evaluate(() => {
    const curve = /** @type {any} */ (globalThis).faircurveEditor.stage.curves[0];
    return curve.at((curve.knotPlaces[8] + curve.knotPlaces[9]) / 2);
  });
  await click(page, on.x, on.y);
  const after = await curves(page);
  assert.equal((await state(page)).contours[0].knots.length, 21);
  assert.ok(Math.abs(after[0].length - before[0].length) < 0.01);
  await page.keyboard.press("Alt+n");
  for (const [x, y] of [[0, 0], [200, 0], [300, 100]]) await click(page, x, y);
  await page.keyboard.press("Escape");
  await click(page, 0, 0);
  await click(page, -100, 200);
  assert.deepEqual((await state(page)).contours[0].knots.map(({ x }) => x), [-100, 0, 200, 300]);
  assert.deepEqual(problems, []);
  await context.close();
});

test("what can't be met is dashed, marked and explained", async () => {
  const { page, problems, context } = await open(browser, site.url);
  // A knot given a curvature, a tangent, and no room.
  const hard = {"faircurve":1,"contours":[{"closed":false,"knots":[{"x":0,"y":0},{"x":100,"y":0,"join":"g4","tangent":[0,-1],"curvature_in":0.3},{"x":110,"y":40,"join":"g4","tangent":[-1,0],"curvature_in":-0.4},{"x":300,"y":20,"join":"g4","tangent":[-1,-0.2]},{"x":305,"y":20,"join":"g4","tangent":[0,1],"curvature_in":-1},{"x":400,"y":300}]}]};
  await choose(page, () => page.keyboard.press("Control+o"), { name: "hard.json", mimeType: "application/json", buffer: Buffer.from(JSON.stringify(hard)) });
  await page.waitForFunction(() => document.querySelector("#name")?.textContent === "hard.json");
  const [{ relaxed }] = await curves(page);
  assert.ok(relaxed.length > 0);
  await page.locator("#hint.relaxed").waitFor();
  const words = (await page.locator("#hint").textContent()) ?? "";
  assert.ok(words.startsWith("Dashed: contour 1") && words.includes(relaxed[0].reason ?? "?"), words);
  await shot(page, "relaxed");
  assert.deepEqual(problems, []);
  await context.close();
});

test("the fairness test keeps answers and sums them up", async () => {
  const { page, problems, context } = await open(browser, site.url);
  await page.getByRole("button", { name: "View", exact: true }).click();
  await page.getByRole("menuitem", { name: "Which is the fairest?" }).click();
  assert.equal(await page.locator(".variant").count(), 9);
  assert.doesNotMatch((await page.locator("dialog.test").textContent()) ?? "", /α/, "variants have no names");
  await shot(page, "fairness");
  for (let i = 0; i < 3; i++) {
    await page.locator(".variant").nth(i * 3).click();
    if (i < 2) await page.getByRole("button", { name: "Once more" }).click();
  }
  await page.getByText("3 answers in this browser").waitFor();
  await shot(page, "fairness-answers");
  await page.reload();
  await ready(page);
  assert.equal(await page.evaluate(() => JSON.parse(localStorage.getItem("faircurve.fairness-test") ?? "[]").length), 3);
  assert.deepEqual(problems, []);
  await context.close();
});

test("a picture to trace is kept with its opacity", async () => {
  const { page, problems, context } = await open(browser, site.url);
  const png = await page.screenshot({ clip: { x: 0, y: 0, width: 200, height: 100 } });
  await page.getByRole("button", { name: "File", exact: true }).click();
  await choose(page, () => page.getByRole("menuitem", { name: "Picture to trace…" }).click(), { name: "a.png", mimeType: "image/png", buffer: png });
  await page.getByLabel("Opacity of the picture").waitFor();
  await page.getByLabel("Opacity of the picture").fill("60");
  await page.getByLabel("Height of the picture in units").fill("700");
  await page.getByLabel("Height of the picture in units").press("Enter");
  await page.waitForTimeout(200);
  await page.reload();
  await ready(page);
  const { opacity, height } = await page.evaluate(() => {
    const { background } = /** @type {any} */ (globalThis).faircurveEditor.stage;
    return { opacity: background.opacity, height: background.height };
  });
  assert.deepEqual([opacity, height], [0.6, 700]);
  assert.deepEqual(problems, []);
  await context.close();
});

test("axe finds no serious fault, in light and dark, with panels and dialogs open, at 200 %", async () => {
  for (const options of /** @type {import("playwright-core").BrowserContextOptions[]} */ ([{ colorScheme: "light" }, { colorScheme: "dark" }, { colorScheme: "light", viewport: { width: 640, height: 450 }, deviceScaleFactor: 2 }])) {
    const { page, context } = await open(browser, site.url, options);
    const check = async (/** @type {string} */ where) => {
      await page.evaluate(axe.source);
      const { violations } = await page.evaluate(() => /** @type {any} */ (globalThis).axe.run());
      const bad = violations.filter((/** @type {any} */ v) => v.impact === "serious" || v.impact === "critical");
      assert.deepEqual(bad.map((/** @type {any} */ v) => `${where}: ${v.id}: ${v.nodes.map((/** @type {any} */ n) => n.html).join(" ")}`), []);
    };
    await check("empty");
    await page.getByRole("button", { name: "A letter" }).click();
    await page.keyboard.press("n");
    await page.keyboard.press("u");
    await check("letter");
    await shot(page, `axe-${options.colorScheme}-${options.viewport?.width ?? 1280}`);
    await page.keyboard.press("s");
    await check("compare");
    await page.keyboard.press("F1");
    await check("help");
    await shot(page, `help-${options.colorScheme}`);
    await page.keyboard.press("Escape");
    await page.keyboard.press("?");
    await check("keys");
    await page.keyboard.press("Escape");
    await page.getByRole("button", { name: "File", exact: true }).focus();
    await page.keyboard.press("Enter");
    await check("menu");
    await context.close();
  }
});

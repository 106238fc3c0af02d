// What an empty page says.

import { EXAMPLES } from "../examples.js";
import { byId, h } from "./dom.js";

/** @param {import("../app.js").App} app */
export function buildWelcome(app) {
  const examples = EXAMPLES.map((example) => h("button", { type: "button", onclick: () => app.openExample(example) }, example.name));
  const help = h("button", { type: "button", onclick: () => app.openHelp() }, "How to draw");
  const open = h("button", { type: "button", onclick: () => void app.keeping.pick() }, "Open a file…");
  const element = h("div", { id: "welcome" }, h("p", {}, "Click anywhere: the curve goes through where you click."), h("div", { class: "buttons" }, ...examples, open, help));
  byId("stage").append(element);
  const update = () => (element.hidden = app.editor.contours.length > 0 && !(app.editor.isPreviewing && app.editor.committed.document.glyphs.every((g) => g.contours.length === 0)));
  app.editor.subscribe(update);
  update();
}

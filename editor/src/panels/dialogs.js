// Dialogs: what went wrong, questions, keys, help.

import { ACTIONS, labelOf } from "../actions.js";
import { keyWords } from "../keys.js";
import { EXAMPLES } from "../examples.js";
import { JOINS } from "../core/joins.js";
import { symbolPicture } from "../view/symbols.js";
import { h } from "./dom.js";

/** @typedef {import("../app.js").App} App */

/**
 * A dialog that goes when it is closed.
 * @param {string} title
 * @param {string} kind a class
 * @param {...(Node | string)} children
 */
export function dialog(title, kind, ...children) {
  const close = h("button", { type: "button", class: "close", "aria-label": "Close", onclick: () => element.close() }, "×");
  const element = h("dialog", { class: kind, "aria-label": title, tabindex: -1 }, h("header", {}, h("h2", {}, title), close), ...children);
  element.addEventListener("close", () => element.remove());
  element.addEventListener("click", (event) => event.target === element && element.close());
  document.body.append(element);
  element.showModal();
  element.focus();
  return element;
}

/** @param {unknown} error */
export function complain(error) {
  const { message, hint } = /** @type {{message: string, hint?: string}} */ (error);
  dialog("That didn't work", "message", h("p", { class: "error" }, h("b", {}, "error: "), message), hint ? h("p", {}, h("b", {}, "hint: "), hint) : "");
}

/**
 * @param {string} title
 * @param {string} words
 * @param {[answer: string, label: string][]} answers
 * @returns {Promise<string>}
 */
export function ask(title, words, answers) {
  return new Promise((resolve) => {
    let given = "";
    const buttons = answers.map(([answer, label]) =>
      h("button", {
        type: "button",
        onclick() {
          given = answer;
          element.close();
        },
      }, label));
    const element = dialog(title, "message", h("p", {}, words), h("div", { class: "buttons" }, ...buttons));
    element.addEventListener("close", () => resolve(given));
  });
}

/** @param {App} app */
export function openKeys(app) {
  const groups = [...new Set(ACTIONS.map(({ group }) => group))];
  const sections = groups.map((group) => {
    const rows = ACTIONS.filter((action) => action.group === group && action.keys).map((action) =>
      h("tr", {}, h("th", { scope: "row" }, labelOf(action, app)), h("td", {}, ...(action.keys ?? []).flatMap((key, i) => [i ? " " : "", h("kbd", {}, keyWords(key))]))));
    return h("section", {}, h("h3", {}, group), h("table", {}, h("tbody", {}, ...rows)));
  });
  const pointer = /** @type {[string, string][]} */ ([
    ["Corner while drawing", "⇧ click"], ["Without snapping; a knot on top of a curve", `${keyWords("Mod")} while clicking or dragging`], ["Add to the selection", "⇧ click, ⇧ drag"], ["Along an axis", "⇧ while dragging"],
    ["Frame: even, or steps of 15°", "⇧ while dragging"], ["Frame: from the centre", "Alt while dragging"], ["One side of a tangent", "Alt while dragging"],
    ["Change the join, insert a knot", "double click"], ["Pan", "space and drag, or the wheel"], ["Zoom", `${keyWords("Mod")} and the wheel, two fingers`],
  ]);
  const rows = pointer.map(([what, how]) => h("tr", {}, h("th", { scope: "row" }, what), h("td", {}, how)));
  dialog("All keys", "keys", h("p", { class: "note" }, "With the pen, the arrows move it by 10, with ⇧ by 100, with Alt by 1; Enter puts a knot there, ⇧ Enter a corner; on the first knot it closes."),
    h("div", { class: "columns" }, h("section", {}, h("h3", {}, "Pointer"), h("table", {}, h("tbody", {}, ...rows))), ...sections));
}

/** @param {App} app */
export function openHelp(app) {
  const examples = EXAMPLES.map((example) =>
    h("button", {
      type: "button", class: "example",
      onclick() {
        element.close();
        app.openExample(example);
      },
    }, h("b", {}, example.name), h("span", {}, example.words)));
  const joins = JOINS.map(({ words, meaning, symbol, key }) =>
    h("li", {}, h("span", { class: "symbol", html: symbolPicture(symbol) }), h("b", {}, words), ` ${meaning}. `, h("kbd", {}, key)));
  const element = dialog("How to draw", "help",
    h("p", {}, "Click, and the curve goes through where you clicked, as fair as it can. There are no control points: to change the curve, drag a knot, or change how the curve joins there."),
    h("ol", {},
      h("li", {}, h("b", {}, "Draw. "), "Click for a smooth knot, ⇧ click for a corner. Click the first knot to close. Two corners in a row are joined by a straight line."),
      h("li", {}, h("b", {}, "Use few knots. "), "One at each extremum, top, bottom, left and right, is a good start. Where a straight stem runs into a curve, take “line to curve”."),
      h("li", {}, h("b", {}, "Look at the comb "), h("kbd", {}, "C"), ". Teeth are long where the curve bends much. Where they change evenly the eye sees a fair curve; where they dip and bulge, a knot is too many or a little off."),
      h("li", {}, h("b", {}, "Compare. "), "“Compare splines” ", h("kbd", {}, "S"), " draws the same knots by other methods."),
      h("li", {}, h("b", {}, "Take it along. "), "Drawings stay in this browser. Save them as JSON, export SVG, copy path data or a link. Fonts that were drawn with Spiro in FontForge (.sfd) open, too.")),
    h("h3", {}, "Joins"), h("ul", { class: "join-list" }, ...joins),
    h("h3", {}, "Examples"), h("div", { class: "examples" }, ...examples),
    h("p", { class: "note" }, "Opening an example can be undone. A dashed curve is the best that there is where something can't be met; the marked knot says why."));
}

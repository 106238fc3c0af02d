// The menus: the table of actions, by group.

import { ACTIONS, isEnabled, labelOf } from "../actions.js";
import { keyWords } from "../keys.js";
import { byId, h } from "./dom.js";

/** @typedef {import("../app.js").App} App */

const MENUS = /** @type {const} */ (["File", "Edit", "Knot", "Shape", "View", "Help"]);

/** @param {App} app */
export function buildMenus(app) {
  const bar = byId("menus");
  for (const group of MENUS) {
    const id = `menu-${group.toLowerCase()}`;
    const list = h("div", { id, class: "menu", popover: "auto", role: "menu", "aria-label": group });
    const button = h("button", { type: "button", class: "menu-button", popovertarget: id, "aria-haspopup": "menu" }, group);
    list.addEventListener("beforetoggle", (event) => {
      if (/** @type {ToggleEvent} */ (event).newState !== "open") return;
      fill(app, list, group);
      const box = button.getBoundingClientRect();
      list.style.left = `${Math.min(box.left, innerWidth - 280)}px`;
      list.style.top = `${box.bottom + 2}px`;
    });
    list.addEventListener("toggle", (event) => {
      button.setAttribute("aria-expanded", String(/** @type {ToggleEvent} */ (event).newState === "open"));
    });
    list.addEventListener("keydown", (event) => walk(event, list));
    // With one menu open, pointing at another opens that.
    button.addEventListener("pointerenter", () => {
      if (document.querySelector(".menu:popover-open") && !list.matches(":popover-open")) list.showPopover();
    });
    button.addEventListener("keydown", (event) => {
      if (event.key !== "ArrowDown") return;
      event.preventDefault();
      list.showPopover();
    });
    bar.append(button, list);
  }
}

/** @param {App} app @param {HTMLElement} list @param {string} group */
function fill(app, list, group) {
  const actions = ACTIONS.filter((action) => action.group === group && !action.hidden);
  const first = actions.find((action) => isEnabled(action, app));
  list.replaceChildren(...actions.flatMap((action) => {
    const checked = action.checked?.(app);
    const item = h("button", {
      type: "button", class: "menu-item", disabled: !isEnabled(action, app), autofocus: action === first, "data-action": action.id,
      role: checked === undefined ? "menuitem" : "menuitemcheckbox", "aria-checked": checked,
      onclick() {
        list.hidePopover();
        app.stage.canvas.focus();
        action.run(app);
      },
    }, h("span", { class: "check" }, checked ? "✓" : ""), h("span", { class: "label" }, labelOf(action, app)),
    h("kbd", {}, action.keys ? keyWords(action.keys[0]) : ""));
    return action.divided ? [h("hr"), item] : [item];
  }));
}

/** @param {KeyboardEvent} event @param {HTMLElement} list */
function walk(event, list) {
  const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
  if (by) {
    event.preventDefault();
    const items = [.../** @type {NodeListOf<HTMLElement>} */ (list.querySelectorAll("button:not(:disabled)"))];
    const at = items.findIndex((item) => item === document.activeElement);
    items[(at + by + items.length) % items.length]?.focus();
  }
  const over = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
  if (over) {
    event.preventDefault();
    const menus = [...document.querySelectorAll(".menu")];
    const next = menus[(menus.indexOf(list) + over + menus.length) % menus.length];
    list.hidePopover();
    /** @type {HTMLElement} */ (next).showPopover();
  }
}

// The rail of tools on the left.

import { TOOLS } from "../tools/tools.js";
import { actionOf } from "../actions.js";
import { byId, h, icon } from "./dom.js";

/** What stands below the tools: actions that are wanted often, where there is no keyboard, too. */
const BUTTONS = [
  { id: "undo", icon: "M8 5L4 9l4 4M4 9h9a6 6 0 0 1 0 12h-3" },
  { id: "redo", icon: "M16 5l4 4-4 4M20 9h-9a6 6 0 0 0 0 12h3" },
  { id: "delete", icon: "M5 7h14M10 7V4h4v3M7 7l1 13h8l1-13" },
  { id: "fit", icon: "M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5" },
];

/** @param {import("../app.js").App} app */
export function buildRail(app) {
  const tools = TOOLS.map((tool) => {
    const button = h("button", {
      type: "button", class: "tool", title: `${tool.label} (${tool.key.toUpperCase()})`, "aria-label": tool.label, html: icon(tool.icon),
      onclick: () => app.useTool(tool.id),
    });
    return { tool, button };
  });
  const corner = h("button", {
    type: "button", class: "tool", title: "Draw corners (X)", "aria-label": "Draw corners", html: icon("M4 19L12 6l8 13"),
    onclick: () => actionOf("next-is-corner").run(app),
  });
  const others = BUTTONS.map(({ id, icon: path }) => {
    const action = actionOf(id);
    const words = { undo: "Undo", redo: "Redo", delete: "Delete knots", fit: "Whole drawing" }[id] ?? id;
    const button = h("button", { type: "button", class: "tool", title: words, "aria-label": words, html: icon(path), onclick: () => action.run(app) });
    return { action, button };
  });
  byId("rail").append(...tools.map(({ button }) => button), corner, h("hr"), ...others.map(({ button }) => button));
  const update = () => {
    for (const { tool, button } of tools) button.setAttribute("aria-pressed", String(tool === app.tool));
    corner.hidden = app.tool.id !== "draw";
    corner.setAttribute("aria-pressed", String(app.settings.values.nextIsCorner));
    for (const { action, button } of others) button.disabled = !(action.enabled?.(app) ?? true);
  };
  app.editor.subscribe(update);
  app.settings.subscribe(update);
  app.onTool(update);
  update();
}

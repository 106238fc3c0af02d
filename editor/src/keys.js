// Keys to actions, and keys in words.

import { ACTIONS, isEnabled } from "./actions.js";

/** @typedef {import("./app.js").App} App */

export const isApple = /Mac|iPhone|iPad/.test(globalThis.navigator?.platform ?? "");

/** The name of a pressed key, as in the table of actions. @param {KeyboardEvent} event */
export function keyName(event) {
  const key = event.key.length === 1 ? event.key.toUpperCase() : event.key;
  const isSign = event.key.length === 1 && event.key.toLowerCase() === event.key.toUpperCase();
  const mod = isApple ? event.metaKey : event.ctrlKey;
  return [mod ? "Mod+" : "", event.altKey ? "Alt+" : "", event.shiftKey && !isSign ? "Shift+" : "", key].join("");
}

const SIGNS = /** @type {Record<string, string>} */ ({
  ArrowLeft: "←", ArrowRight: "→", ArrowUp: "↑", ArrowDown: "↓", Shift: "⇧", Escape: "Esc", Backspace: "⌫", Delete: "Del",
});

/** @param {string} name */
export function keyWords(name) {
  const parts = name === "+" ? ["+"] : name.split("+");
  return parts.map((part) => (part === "Mod" ? (isApple ? "⌘" : "Ctrl") : SIGNS[part] ?? part)).join(isApple ? "" : " ");
}

/** Whether a key belongs to what is focused: to text and lists, and arrows to sliders. @param {EventTarget | null} target @param {string} key */
function isTyping(target, key) {
  if (!(target instanceof HTMLElement)) return false;
  if (target.matches("input[type=range]")) return /^(Arrow|Home|End|Page)/.test(key);
  if (target.matches("input[type=checkbox]")) return key === " ";
  return target.matches("input, select, textarea");
}

/** @param {App} app */
export function listenToKeys(app) {
  addEventListener("keydown", (event) => {
    if (event.defaultPrevented || document.querySelector("dialog[open]")) return;
    const name = keyName(event);
    const typing = isTyping(event.target, event.key);
    if (typing && !name.startsWith("Mod+") && name !== "F1") return;
    // In a field, undo and the like are the field's.
    if (typing && ["Mod+Z", "Mod+Y", "Mod+Shift+Z", "Mod+A", "Mod+C", "Mod+V"].includes(name)) return;
    // Enter and space press buttons.
    if (event.target instanceof HTMLButtonElement && (event.key === "Enter" || event.key === " ")) return;
    const inMenu = event.target instanceof HTMLElement && event.target.closest("[popover]");
    if (inMenu && (event.key.startsWith("Arrow") || event.key === "Escape")) return;
    const action = ACTIONS.find((action) => action.keys?.includes(name));
    if (!action || !isEnabled(action, app)) return;
    event.preventDefault();
    app.editor.isPreviewing && action.id !== "place" && action.id !== "place-corner" && !app.pointers.isDragging && app.editor.cancel();
    action.run(app);
  });
}

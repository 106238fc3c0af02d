// Starts the editor, or says why it can't be started.

import { isWaiting } from "./keeping/waiting.js";

try {
  // A drawing waits to be read: what reads it loads while the rest does.
  if (isWaiting(location)) void import("./curves/files.js").then(({ load }) => load()).catch(() => {});
  const { App } = await import("./app.js");
  const app = new App();
  await app.begin();
  // For scripts in the browser's console, and for tests.
  Object.assign(globalThis, { faircurveEditor: app });
  document.documentElement.dataset.ready = "";
} catch (error) {
  const words = document.createElement("p");
  words.id = "broken";
  words.setAttribute("role", "alert");
  words.textContent = `The editor can't start here: ${error instanceof Error ? error.message : error}. It needs a browser of 2024 or later with WebAssembly.`;
  document.body.append(words);
  throw error;
}

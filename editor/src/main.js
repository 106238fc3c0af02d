import { App } from "./app.js";

const app = new App();
await app.begin();
// For scripts in the browser's console, and for tests.
Object.assign(globalThis, { faircurveEditor: app });
document.documentElement.dataset.ready = "";

// Where drawings come from and go to: files, the clipboard, links, the browser's own store, and the program
// `faircurve edit`.

import { blank, toText } from "../core/document.js";
import { selectedContours } from "../core/commands.js";
import { fromFragment, toFragment } from "../core/link.js";
import { isWritable, readable, readFile, writeFile, writePath, writeSvg } from "../curves/files.js";
import { h } from "../panels/dom.js";
import { forgetPicture, keepPicture, keptPicture } from "./pictures.js";
import { Server } from "./server.js";
import { STORE } from "./waiting.js";

/** @typedef {import("../app.js").App} App */
/** @typedef {import("../core/document.js").Document} Document */

/** Milliseconds after the last change until it is kept. */
const CALM = 300;

export class Keeping {
  /** The file's name, for the next save. */
  name = "drawing.json";
  #server = Server.of(location);
  /** Of the file of `faircurve edit`, when it was read or saved. @type {string | null} */
  #version = null;
  /** What is in the file. @type {Document | null} */
  #saved = null;
  #timer = 0;

  /** @param {App} app */
  constructor(app) {
    this.app = app;
    app.editor.subscribe(() => {
      if (app.editor.isPreviewing) return;
      clearTimeout(this.#timer);
      this.#timer = window.setTimeout(() => this.#keep(), CALM);
      this.#showName();
    });
    addEventListener("pagehide", () => this.#keep());
    document.addEventListener("visibilitychange", () => (document.hidden ? this.#keep() : void this.#lookAtDisk()));
    addEventListener("focus", () => void this.#lookAtDisk());
    addEventListener("hashchange", () => void this.#openLink());
    this.#listenToDrops();
  }

  get saveLabel() {
    return this.#version === null ? "Save as JSON" : `Save ${this.name}`;
  }

  get isChanged() {
    return this.app.editor.committed.document !== this.#saved;
  }

  /** What was there last: the program's file, a link's drawing, or what the browser has kept. */
  async begin() {
    await this.#picture().catch(() => {});
    try {
      if (await this.#openLink()) return;
      const served = await this.#server?.open();
      if (served) {
        this.#version = served.version;
        this.#openDocument(await readFile(served.contents, served.name), served.name);
        return;
      }
      const kept = JSON.parse(localStorage.getItem(STORE) ?? "null");
      if (kept) this.#openDocument(await readFile(kept.document, "json"), kept.name ?? this.name, kept.glyph);
    } catch (error) {
      this.app.complain(error);
    }
    this.#showName();
  }

  /** @param {Document} document @param {string} name @param {number} [glyph] */
  #openDocument(document, name, glyph = 0) {
    const { editor, stage } = this.app;
    // What nobody has drawn in isn't worth a step of undo, yet it is one step: opening can be undone.
    editor.run("open", { document, glyph: document.glyphs[glyph] ? glyph : 0 });
    this.name = name;
    this.#saved = editor.committed.document;
    this.app.useTool("select");
    stage.fit();
    this.#showName();
  }

  /** A drawing that is in no file yet. @param {Document} document @param {string} name */
  openNew(document, name) {
    this.name = name;
    this.#version = null;
    this.app.editor.run("open", { document });
  }

  /** @returns {Promise<boolean>} */
  async #openLink() {
    const text = await fromFragment(location.hash).catch((error) => {
      this.app.complain(error);
      return null;
    });
    if (text === null) return false;
    try {
      this.#openDocument(await readFile(text, "json"), "shared.json");
      // Reloading must not undo what is drawn from now on.
      history.replaceState(null, "", location.pathname + location.search);
      this.app.say("the link's drawing is open; undo brings back what was here");
      return true;
    } catch (error) {
      this.app.complain(error);
      return false;
    }
  }

  #keep() {
    clearTimeout(this.#timer);
    const { document, glyph } = this.app.editor.committed;
    try {
      localStorage.setItem(STORE, JSON.stringify({ document: toText(document), glyph, name: this.name }));
    } catch {
      this.app.say("the browser's store is full: save the drawing as a file");
    }
  }

  #showName() {
    const changed = this.#version !== null && this.isChanged;
    this.app.showName(this.name, changed);
  }

  startNew() {
    this.openNew(blank(), "drawing.json");
    this.app.stage.fit();
    this.app.useTool("draw");
    this.app.say("a new drawing; undo brings back the one before");
  }

  async pick() {
    const input = h("input", { type: "file", accept: (await readable()).join() });
    input.addEventListener("change", () => input.files?.[0] && void this.openFile(input.files[0]));
    input.click();
  }

  /** @param {File} file */
  async openFile(file) {
    if (file.type.startsWith("image/") && !/\.svg$/i.test(file.name)) return this.#usePicture(file);
    try {
      this.#openDocument(await readFile(new Uint8Array(await file.arrayBuffer()), file.name), file.name);
      this.#version = null;
      this.#showName();
      this.app.say(`${file.name} is open`);
    } catch (error) {
      this.app.complain(error);
    }
  }

  async save() {
    const { document } = this.app.editor.committed;
    if (this.#server && this.#version !== null) return this.#saveToServer(document, this.#version);
    download(`${this.name.replace(/\.[^.]*$/, "")}.json`, "application/json", toText(document));
    this.#saved = document;
    this.app.say("saved among your downloads");
  }

  /** @param {Document} document @param {string} version */
  async #saveToServer(document, version) {
    try {
      if (!(await isWritable(this.name))) {
        const hint = "use Export, or start `faircurve edit` with a .json file";
        throw Object.assign(new Error(`${this.name} can be read, but not written`), { hint });
      }
      this.#version = await /** @type {Server} */ (this.#server).save(await writeFile(document, this.name), version);
      this.#saved = document;
      this.#showName();
      this.app.say(`${this.name} is saved`);
    } catch (error) {
      if (/** @type {any} */ (error).status === 412) await this.#askAboutDisk();
      else this.app.complain(error);
    }
  }

  async #askAboutDisk() {
    const answer = await this.app.ask(`${this.name} has changed on disk`, "Something else has written the file since it was opened here.",
      [["reload", "Open what is on disk"], ["overwrite", "Save over it"], ["", "Neither"]]);
    if (answer === "overwrite") await this.#saveToServer(this.app.editor.committed.document, "*");
    if (answer === "reload") await this.begin();
  }

  async #lookAtDisk() {
    if (!this.#server || this.#version === null) return;
    const now = await this.#server.version().catch(() => null);
    if (now === null || now === this.#version) return;
    if (!this.isChanged) {
      await this.begin();
      this.app.say(`${this.name} has changed on disk and is open as it is now`);
    } else {
      this.app.say(`${this.name} has changed on disk; saving asks what to do`);
    }
  }

  /** The open glyph alone, as a document. */
  #glyphAlone() {
    const { document, glyph } = this.app.editor.committed;
    return { ...document, glyphs: [document.glyphs[glyph]] };
  }

  /** Where the browser doesn't let the page copy, the user can. @param {string} text @param {string} words */
  async #toClipboard(text, words) {
    try {
      await navigator.clipboard.writeText(text);
      this.app.say(words);
    } catch {
      const area = h("textarea", { readonly: true, rows: 8, "aria-label": "To copy" });
      area.value = text;
      this.app.dialog("Copy this", "message", area);
      area.select();
    }
  }

  async exportSvg() {
    try {
      const glyph = this.#glyphAlone();
      const text = await writeSvg(glyph, this.app.settings.values.accuracy);
      download(`${glyph.glyphs[0].name || this.name.replace(/\.[^.]*$/, "")}.svg`, "image/svg+xml", text);
    } catch (error) {
      this.app.complain(error);
    }
  }

  async copyPath() {
    try {
      await this.#toClipboard(await writePath(this.#glyphAlone(), this.app.settings.values.accuracy), "path data is on the clipboard");
    } catch (error) {
      this.app.complain(error);
    }
  }

  async share() {
    try {
      const link = new URL(location.pathname, location.href);
      link.hash = await toFragment(this.#glyphAlone());
      await this.#toClipboard(link.href, `a link with the whole drawing is on the clipboard: ${link.href.length} characters`);
    } catch (error) {
      this.app.complain(error);
    }
  }

  async copy() {
    const { editor } = this.app;
    const contours = selectedContours(editor.state);
    const { document } = editor.committed;
    const many = contours.length === 1 ? "a contour is" : `${contours.length} contours are`;
    await this.#toClipboard(toText({ ...document, glyphs: [{ name: "", layer: "", contours }] }), `${many} on the clipboard`);
  }

  async paste() {
    try {
      const text = await navigator.clipboard.readText().catch(() => {
        throw Object.assign(new Error("the browser doesn't let this page read the clipboard"), { hint: "allow it beside the page's address, or drop a file here" });
      });
      const { glyphs } = await readFile(text, "json");
      this.app.editor.run("paste", { contours: glyphs.flatMap(({ contours }) => contours) });
    } catch (error) {
      this.app.complain(error);
    }
  }

  async pickPicture() {
    const input = h("input", { type: "file", accept: "image/*" });
    input.addEventListener("change", () => input.files?.[0] && void this.#usePicture(input.files[0]));
    input.click();
  }

  /** @param {File} file */
  async #usePicture(file) {
    try {
      const { background, viewport } = this.app.stage;
      background.image = await createImageBitmap(file);
      this.#blob = file;
      // As high as most of what is seen.
      const { x0, y0, x1, y1 } = viewport.box;
      background.height = Math.round(0.8 * (y1 - y0));
      background.x = Math.round((x0 + x1) / 2 - (background.image.width * background.scale) / 2);
      background.y = Math.round(y0 + 0.1 * (y1 - y0));
      this.keepPicture();
      this.app.settings.set({});
      this.app.say("trace away; its opacity, height and lock are in the panel");
    } catch {
      this.app.complain(Object.assign(new Error(`${file.name} isn't a picture that the browser can show`), { hint: "use PNG, JPEG or WebP" }));
    }
  }

  /** @type {Blob | null} */
  #blob = null;

  async #picture() {
    const kept = await keptPicture();
    if (!kept) return;
    const { blob, ...placed } = kept;
    this.#blob = blob;
    Object.assign(this.app.stage.background, placed, { image: await createImageBitmap(blob) });
    this.app.settings.set({});
  }

  keepPicture() {
    const { x, y, scale, opacity, locked } = this.app.stage.background;
    if (this.#blob) void keepPicture({ blob: this.#blob, x, y, scale, opacity, locked }).catch(() => {});
  }

  removePicture() {
    this.#blob = null;
    this.app.stage.background.image = null;
    this.app.settings.set({});
    void forgetPicture().catch(() => {});
  }

  #listenToDrops() {
    addEventListener("dragover", (event) => event.preventDefault());
    addEventListener("drop", (event) => {
      event.preventDefault();
      const [file] = event.dataTransfer?.files ?? [];
      if (file) void this.openFile(file);
    });
  }
}

/** @param {string} name @param {string} type @param {string} text */
function download(name, type, text) {
  const url = URL.createObjectURL(new Blob([text], { type }));
  h("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

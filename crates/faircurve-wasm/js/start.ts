/** The script of a module of WebAssembly, as wasm-bindgen writes it. */
interface Script {
  default(from: { module_or_path: Promise<Response> }): Promise<unknown>;
  initSync(from: { module: BufferSource }): unknown;
}

/** Starts a module from its file, in a browser or in Node. */
export async function start(script: Script, url: URL): Promise<void> {
  if (url.protocol === "file:") {
    const { readFile } = await import("node:fs/promises");
    // At once: the other way asks Node for its `Response`, which takes longer to load than all of this.
    script.initSync({ module: await readFile(url) });
  } else {
    await script.default({ module_or_path: fetch(url) });
  }
}

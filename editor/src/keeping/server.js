// The program `faircurve edit`, where the page comes from it: the one file that it opens and saves.

/** @typedef {{name: string, contents: Uint8Array, version: string}} Served */

const TOKEN = "token";

/** An error in the program's words. @param {Response} answer */
async function failure(answer) {
  const { error, hint } = await answer.json().catch(() => ({ error: `the program answered ${answer.status}`, hint: "" }));
  return Object.assign(new Error(error), { hint, status: answer.status });
}

export class Server {
  /** @param {string} token */
  constructor(token) {
    this.token = token;
  }

  /** The program that the page comes from, if it does. @param {Location} location */
  static of(location) {
    const token = new URLSearchParams(location.search).get(TOKEN);
    return token ? new Server(token) : null;
  }

  /** @param {string} method @param {Record<string, string>} [headers] @param {string} [body] */
  async #ask(method, headers = {}, body) {
    try {
      return await fetch("api/file", { method, headers: { "X-Faircurve-Token": this.token, ...headers }, body, cache: "no-store" });
    } catch {
      throw Object.assign(new Error("the program `faircurve edit` doesn't answer"), { hint: "start it again; the drawing is kept in the browser meanwhile" });
    }
  }

  /** The file; `null` where the program was started without one. @returns {Promise<Served | null>} */
  async open() {
    const answer = await this.#ask("GET");
    if (answer.status === 204) return null;
    if (!answer.ok) throw await failure(answer);
    return {
      name: decodeURIComponent(answer.headers.get("X-Faircurve-Name") ?? "drawing.json"),
      contents: new Uint8Array(await answer.arrayBuffer()),
      version: answer.headers.get("ETag") ?? "",
    };
  }

  /** What the file's version is now. */
  async version() {
    const answer = await this.#ask("HEAD");
    return answer.ok ? answer.headers.get("ETag") : null;
  }

  /**
   * Saves the file whole; its new version. An error's `status` is 412 where it isn't `version` on disk any more.
   * @param {string} contents
   * @param {string} version `*` for whatever there is
   */
  async save(contents, version) {
    const answer = await this.#ask("PUT", { "If-Match": version, "Content-Type": "application/octet-stream" }, contents);
    if (!answer.ok) throw await failure(answer);
    return answer.headers.get("ETag") ?? "";
  }
}

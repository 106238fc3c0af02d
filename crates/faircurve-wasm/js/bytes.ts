/** A file of this package, in a browser or in Node: its bytes, or the server's answer with them. */
export async function bytesOf(url: URL): Promise<Response | BufferSource> {
  if (url.protocol !== "file:") return fetch(url);
  const { readFile } = await import("node:fs/promises");
  return readFile(url);
}

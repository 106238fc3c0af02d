// The picture to trace, kept in the browser's database: it is too large for the other store.

/** @typedef {{blob: Blob, x: number, y: number, scale: number, opacity: number, locked: boolean}} Kept */

const [NAME, STORE, KEY] = ["faircurve", "pictures", "background"];

/** @param {IDBTransactionMode} mode @param {(store: IDBObjectStore) => IDBRequest} ask @returns {Promise<any>} */
function within(mode, ask) {
  return new Promise((resolve, reject) => {
    const opening = indexedDB.open(NAME, 1);
    opening.onupgradeneeded = () => opening.result.createObjectStore(STORE);
    opening.onerror = () => reject(opening.error);
    opening.onsuccess = () => {
      const request = ask(opening.result.transaction(STORE, mode).objectStore(STORE));
      request.onsuccess = () => resolve(request.result);
      request.onerror = () => reject(request.error);
    };
  });
}

/** @param {Kept} kept */
export const keepPicture = (kept) => within("readwrite", (store) => store.put(kept, KEY));
/** @returns {Promise<Kept | undefined>} */
export const keptPicture = () => within("readonly", (store) => store.get(KEY));
export const forgetPicture = () => within("readwrite", (store) => store.delete(KEY));

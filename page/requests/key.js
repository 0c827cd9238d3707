/** The key that a service may ask for, kept for this tab alone. */

const KEPT = "jointplay-key";

/** Returns the headers that show the key; none where none was given. */
export function keyHeaders() {
  const key = sessionStorage.getItem(KEPT);
  return key ? { Authorization: `Bearer ${key}` } : {};
}

/** Keeps a key until the tab is closed. */
export function keepKey(key) {
  sessionStorage.setItem(KEPT, key.trim());
}

/**
 * Returns an address that pictures and downloads can have: a copy, where a key is needed.
 *
 * @param changes whether the picture does: a browser shows what it has of an address once more
 */
export async function openAddress(path, changes = false) {
  if (!changes && !keyHeaders().Authorization) return path;
  const answer = await fetch(path, { headers: keyHeaders() });
  return answer.ok ? URL.createObjectURL(await answer.blob()) : path;
}

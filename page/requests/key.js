/** The key that a service may ask for, kept for this tab alone. */

import { keep, kept } from "./kept.js";

const KEPT = "jointplay-key";

/** Returns the headers that show the key; none where none was given. */
export function keyHeaders() {
  const key = kept(KEPT);
  return key ? { Authorization: `Bearer ${key}` } : {};
}

/** Keeps a key until the tab is closed. */
export function keepKey(key) {
  keep(KEPT, key.trim());
}

/**
 * Returns an address that pictures and downloads can have: a copy, where a key is needed.
 *
 * Where the service does not answer, it is the path: the picture's description is shown then.
 *
 * @param changes whether the picture does: a browser shows what it has of an address once more
 */
export async function openAddress(path, changes = false) {
  if (!changes && !keyHeaders().Authorization) return path;
  try {
    const answer = await fetch(path, { headers: keyHeaders() });
    return answer.ok ? URL.createObjectURL(await answer.blob()) : path;
  } catch {
    return path;
  }
}

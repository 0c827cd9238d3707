/** The scene that is being written: the tab keeps it while other views are looked at. */

const KEPT = "jointplay-scene"; // in the tab's storage

/** Keeps the text of the editor. */
export function keep(text) {
  sessionStorage.setItem(KEPT, text);
}

/** Returns the text that was kept; null: none was. */
export function kept() {
  return sessionStorage.getItem(KEPT);
}

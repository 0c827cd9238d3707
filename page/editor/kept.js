/** The scene that is being written: the tab keeps it while other views are looked at. */

import * as tab from "../requests/kept.js";

const KEPT = "jointplay-scene";

/** Keeps the text of the editor. */
export function keep(text) {
  tab.keep(KEPT, text);
}

/** Returns the text that was kept; null: none was. */
export function kept() {
  return tab.kept(KEPT);
}

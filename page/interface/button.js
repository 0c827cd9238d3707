/** Buttons: those that act at once, and those that wait until what they began is done. */

import { element } from "./element.js";

/** Returns a button; `content` is a text, or parts of one. */
export function button(content, onclick, attributes = {}) {
  return element("button", { type: "button", onclick, ...attributes }, content);
}

/**
 * Returns a button that begins nothing anew while its work goes on. It keeps the keyboard, which a disabled one loses.
 *
 * @param work does what the button says
 * @param tell called with null when it begins and when it is done; with its error where it fails
 */
export function workButton(content, work, tell, attributes = {}) {
  let busy = false;
  const made = button(content, async () => {
    if (busy) return;
    busy = true;
    made.setAttribute("aria-disabled", "true");
    tell(null);
    try {
      await work();
      tell(null);
    } catch (error) {
      tell(error);
    } finally {
      busy = false;
      made.removeAttribute("aria-disabled");
    }
  }, attributes);
  return made;
}

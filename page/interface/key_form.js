/** A field for the key that a service asks for, wherever it is asked for. */

import { element } from "./element.js";
import { keepKey, keyHeaders } from "../requests/key.js";

/** Returns the form; the view is shown anew with the key that is given: text and address are kept. */
export function keyForm() {
  const key = element("input", { id: "key", type: "password", autocomplete: "off", required: true,
    pattern: "\\s*[!-~]+\\s*", // no request can be sent with others
    title: "A key begins with jp_, and has letters without accents, digits and - or _ behind it." });
  const given = (event) => {
    event.preventDefault();
    keepKey(key.value);
    location.reload();
  };
  const wanted = keyHeaders().Authorization ? "This needs another key" : "This service asks for a key";
  return element("section", { class: "trouble", "aria-label": "Key" },
    element("form", { class: "stacked", onsubmit: given },
      element("label", { for: "key" }, `${wanted} (jp_…); it is kept until this tab is closed`), key,
      element("div", { class: "buttons" }, element("button", { type: "submit", class: "main" }, "Use it"))));
}

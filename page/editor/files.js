/** Buttons that save the text of a scene as a file, and open one. */

import { button } from "../interface/button.js";
import { element } from "../interface/element.js";
import { save } from "../interface/saving.js";

const LARGEST = 16e6; // bytes; no scene is so large
const UNFIT = /[^A-Za-z0-9_-]+/g; // in names of files

/**
 * Returns the buttons, and what they say.
 *
 * @param written returns the text, and the name that its scene has, if it has one: `{text, name}`
 * @param opened called with the text of a file that was chosen
 */
export function sceneFiles(written, opened) {
  const said = element("span", { role: "status", class: "small quiet" });
  const input = element("input", {
    type: "file", accept: ".json,application/json", hidden: true, "aria-label": "A file with a scene",
    onchange: async () => {
      const [file] = input.files;
      input.value = ""; // the same file may be opened again
      if (!file) return;
      said.textContent = file.size > LARGEST ? `${file.name} is too large to be a scene.` : `${file.name} is open.`;
      if (file.size <= LARGEST) opened(await file.text());
    },
  });
  const saving = () => {
    const { text, name } = written();
    const file = `${String(name ?? "").replaceAll(UNFIT, "-") || "scene"}.json`;
    save(new Blob([text], { type: "application/json" }), file);
    said.textContent = `Saved as ${file}.`;
  };
  return [
    button("Open a file …", () => input.click()),
    button("Save as a file", saving),
    input, said,
  ];
}

/** Buttons that save a moment as SVG, and a stretch of time as a film. */

import { LENGTHS, stretch } from "../film/stretch.js";
import { workButton } from "./button.js";
import { element } from "./element.js";

const FILMS = { gif: "GIF", mp4: "MP4", webm: "WebM" };

/**
 * Returns the buttons of a stage and its clock.
 *
 * @param insets its magnified joints, `impacts()` the onsets of contacts in s, sorted
 * @param name of the files
 */
export function saving({ stage, insets, clock, impacts, name }) {
  const said = element("span", { role: "status", class: "small quiet" });
  const tell = (text) => (said.textContent = text);
  const length = element("select", { "aria-label": "Length of the film" },
    Object.entries(LENGTHS).map(([value, text]) => element("option", { value }, text)));
  const saved = (text, act) => workButton(text, act, (error) => tell(error?.message ?? ""));
  return [
    saved("SVG", async () => {
      const { still } = await import("../film/still.js");
      const text = await still(stage, insets, clock.time);
      save(new Blob([text], { type: "image/svg+xml" }), `${name}.svg`);
    }),
    Object.entries(FILMS).map(([form, text]) => saved(text, async () => {
      clock.stop();
      const shown = stretch(length.value, clock, impacts());
      const { film } = await import("../film/film.js");
      save(await film(form, stage, insets, shown, tell), `${name}.${form}`);
    })),
    element("label", { class: "buttons small" }, "of ", length),
    said,
  ];
}

/** Hands a file to the browser's downloads. */
export function save(blob, name) {
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** Buttons that save a moment as SVG or PNG, and a stretch of time as a film. */

import { element } from "./element.js";

/** Returns the buttons of a stage and its clock. */
export function saving(stage, clock, name) {
  const said = element("span", { role: "status", class: "small quiet" });
  const button = (text, act) => element("button", {
    type: "button",
    onclick: async (event) => {
      event.target.disabled = true;
      try {
        await act();
        said.textContent = "";
      } catch (error) {
        said.textContent = error.message;
      } finally {
        event.target.disabled = false;
      }
    },
  }, text);
  const tell = (text) => (said.textContent = text);
  return [
    button("SVG", () => save(new Blob([stage.svg(clock.time)], { type: "image/svg+xml" }), `${name}.svg`)),
    button("Film", async () => {
      const { film } = await import("../mechanism/film.js");
      const { blob, suffix } = await film(stage, clock, tell);
      save(blob, `${name}.${suffix}`);
    }),
    button("GIF", async () => {
      const { gif } = await import("../mechanism/gif.js");
      save(await gif(stage, clock, tell), `${name}.gif`);
    }),
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

/** Figures of a job as a journal would print them, drawn by the service. */

import { element, fill } from "../../interface/element.js";
import { save } from "../../interface/saving.js";
import { whenThere } from "../../interface/when_there.js";
import { openAddress } from "../../requests/key.js";
import { getBytes } from "../../requests/service.js";

const TYPES = { PNG: "image/png", SVG: "image/svg+xml" };

export async function show(room, context) {
  await whenThere(room, context, context.job.links.figures, {}, ({ figures }) =>
    fill(room, element("div", { class: "figures" }, figures.map((figure) => shown(figure, context.signal)))));
}

function shown({ name, title, png, svg }, signal) {
  const image = element("img", {
    alt: title, loading: "lazy", onload: ({ target }) => URL.revokeObjectURL(target.src),
  });
  const said = element("span", { role: "status" });
  const links = [["PNG", png], ["SVG", svg]].map(([form, path]) => element("a", {
    href: path, download: `${name}.${form.toLowerCase()}`,
    onclick: async (event) => {
      event.preventDefault(); // a browser would ask without the key, and save the refusal
      const { download } = event.currentTarget;
      try {
        save(new Blob([await getBytes(path, TYPES[form], signal)], { type: TYPES[form] }), download);
        fill(said);
      } catch (error) {
        if (error.name !== "AbortError") fill(said, ` ${error.message}`);
      }
    },
  }, form));
  openAddress(png).then((address) => (image.src = address));
  return element("figure", { class: "panel" }, image,
    element("figcaption", { class: "small" }, element("strong", {}, name), ` ${title} `,
      links[0], " ", links[1], said));
}

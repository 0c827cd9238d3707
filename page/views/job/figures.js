/** Figures of a job as a journal would print them, drawn by the service. */

import { element, fill } from "../../interface/element.js";
import { openAddress } from "../../requests/key.js";
import { whenThere } from "../../interface/when_there.js";

export async function show(room, context) {
  await whenThere(room, context, context.job.links.figures, {}, ({ figures }) =>
    fill(room, element("div", { class: "figures" }, figures.map(shown))));
}

function shown({ name, title, png, svg }) {
  const image = element("img", { alt: title, loading: "lazy" });
  const links = [["PNG", png], ["SVG", svg]].map(([form, path]) => element("a", {
    href: path, download: `${name}.${form.toLowerCase()}`,
    onclick: async ({ target }) => (target.href = await openAddress(path)),
  }, form));
  openAddress(png).then((address) => (image.src = address));
  return element("figure", { class: "panel" }, image,
    element("figcaption", { class: "small" }, element("strong", {}, name), ` ${title} `,
      links[0], " ", links[1]));
}

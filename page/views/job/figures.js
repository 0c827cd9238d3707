/** Figures of a job as a journal would print them, drawn by the service. */

import { element, fill } from "../../interface/element.js";
import { whenThere } from "../../interface/when_there.js";

export async function show(room, context) {
  await whenThere(room, context, context.job.links.figures, {}, ({ figures }) =>
    fill(room, element("div", { class: "figures" }, figures.map(({ name, title, png, svg }) =>
      element("figure", { class: "panel" },
        element("img", { src: png, alt: title, loading: "lazy" }),
        element("figcaption", { class: "small" }, element("strong", {}, name), ` ${title} `,
          element("a", { href: png, download: `${name}.png` }, "PNG"), " ",
          element("a", { href: svg, download: `${name}.svg` }, "SVG")))))));
}

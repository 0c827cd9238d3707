/** Figures of a job as a journal would print them, drawn by the service. */

import { element, fill } from "../../interface/element.js";
import { save } from "../../interface/saving.js";
import { whenThere } from "../../interface/when_there.js";
import { TERMINAL } from "../../requests/following.js";
import { openAddress } from "../../requests/key.js";
import { getBytes } from "../../requests/service.js";

const AGAIN = 10000; // ms after which figures of a running job are drawn anew
const TYPES = { PNG: "image/png", SVG: "image/svg+xml" };

export async function show(room, context) {
  const { job, signal } = context;
  const running = !TERMINAL.has(job.state); // as the view is opened
  const pictures = new Map();
  let list = null;
  let listed = "";
  let drawn = -Infinity;
  await whenThere(room, context, job.links.figures, {}, async ({ figures }) => {
    if (!TERMINAL.has(job.state) && performance.now() - drawn < AGAIN) return;
    drawn = performance.now();
    const names = figures.map(({ name }) => name).join();
    if (!list?.isConnected || names !== listed) {
      pictures.clear();
      const made = figures.map((figure) => {
        const image = element("img", {
          alt: figure.title, loading: "lazy", onload: ({ target }) => URL.revokeObjectURL(target.src),
        });
        pictures.set(figure.name, image);
        return shown(figure, image, signal);
      });
      fill(room, list = element("div", { class: "figures" }, made));
      listed = names;
    }
    for (const { name, png } of figures) { // one after the other: the service draws them
      const address = openAddress(png, running).then((found) => (pictures.get(name).src = found));
      if (running) await address;
      if (signal.aborted) return;
    }
  });
}

function shown({ name, title, png, svg }, image, signal) {
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
  return element("figure", { class: "panel" }, image,
    element("figcaption", { class: "small" }, element("strong", {}, name), ` ${title} `,
      links[0], " ", links[1], said));
}

/** Poincaré sections: two channels once in every period, of a run or of all points of a study. */

import { element, fill } from "../../interface/element.js";
import { note } from "../../interface/route.js";
import { whenThere } from "../../interface/when_there.js";
import { Plane, firstPlane } from "../../plots/plane.js";
import { intoATurn } from "../../plots/turns.js";
import { withNext } from "../../requests/pages.js";
import { get } from "../../requests/service.js";

export async function show(room, context) {
  const { job, query, signal } = context;
  const names = job.job.observables ?? job.job.channels;
  const asked = (chosen) => ({ channels: [...new Set(chosen)].join(",") });
  const ask = (chosen, start = null) => get(job.links.poincare, { ...asked(chosen), start }, signal);
  const trouble = element("p", { class: "notice bad", hidden: true });
  const tell = (sentence) => {
    trouble.textContent = sentence;
    trouble.hidden = !sentence;
  };
  const plane = new Plane(names, firstPlane(names, query), signal, async ([x, y]) => {
    note({ x, y });
    try {
      await take(await ask([x, y]));
    } catch (error) {
      if (error.name !== "AbortError" && same(plane.chosen, [x, y])) tell(error.message);
    }
  });
  const panel = element("section", { class: "panel" },
    element("div", { "aria-live": "polite" }, trouble), plane.element);
  const take = async (answer) => {
    const chosen = [...plane.chosen];
    const wanted = () => same(plane.chosen, chosen) && chosen.every((name) => name in answer.channels);
    const pages = await withNext(answer, (start) => ask(chosen, start), wanted);
    if (!pages) return; // others were chosen meanwhile
    const [x, y] = chosen.map((name) => {
      const numbers = pages.flatMap((page) => page.channels[name].values.flat()).map((value) => value ?? NaN);
      return answer.channels[name].unit === "rad" ? numbers.map(intoATurn(numbers)) : numbers;
    });
    const words = x.length === 1 ? "1 section" : `${x.length} sections`;
    const units = chosen.map((name) => answer.channels[name].unit);
    tell("");
    plane.show({ x, y, names: chosen, units, words, note: answer.note });
  };
  await whenThere(room, context, job.links.poincare, () => asked(plane.chosen), async (answer) => {
    if (!panel.isConnected) fill(room, panel);
    await take(answer);
  });
}

function same(one, other) {
  return one.every((name, i) => name === other[i]);
}

/** Poincaré sections: two channels once in every period, of a run or of all points of a study. */

import { element, fill } from "../../interface/element.js";
import { note } from "../../interface/route.js";
import { whenThere } from "../../interface/when_there.js";
import { Plane, firstPlane } from "../../plots/plane.js";
import { intoATurn } from "../../plots/turns.js";
import { get } from "../../requests/service.js";

export async function show(room, context) {
  const { job, query, signal } = context;
  const names = job.job.observables ?? job.job.channels;
  const asked = ([x, y]) => ({ channels: [...new Set([x, y])].join(",") });
  const plane = new Plane(names, firstPlane(names, query), signal, async ([x, y]) => {
    note({ x, y });
    take(await get(job.links.poincare, asked([x, y]), signal));
  });
  const panel = element("section", { class: "panel" }, plane.element);
  const take = (answer) => {
    if (!plane.chosen.every((name) => name in answer.channels)) return; // others were chosen meanwhile
    const found = plane.chosen.map((name) => answer.channels[name]);
    const [x, y] = found.map(({ values, unit }) => {
      const numbers = values.flat().map((value) => value ?? NaN);
      return unit === "rad" ? numbers.map(intoATurn(numbers)) : numbers;
    });
    const words = x.length === 1 ? "1 section" : `${x.length} sections`;
    plane.show({ x, y, units: found.map(({ unit }) => unit), words, note: answer.note });
  };
  await whenThere(room, context, job.links.poincare, () => asked(plane.chosen), (answer) => {
    if (!panel.isConnected) fill(room, panel);
    take(answer);
  });
}

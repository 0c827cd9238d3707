/** Basin stability: how many of the drawn starts end on each attractor, and that over a parameter. */

import { attractorTable, share } from "../../charts/attractors.js";
import { element, fill } from "../../interface/element.js";
import { short, withUnit } from "../../interface/numbers.js";
import { table } from "../../interface/table.js";
import { whenThere } from "../../interface/when_there.js";
import { openAddress } from "../../requests/key.js";

export async function show(room, context) {
  await whenThere(room, context, context.job.links.attractors, {}, async (answer) => {
    const { attractors, along, ended, points } = answer;
    fill(room, element("section", { class: "panel stacked" },
      attractors.length > 0 && await figure(`${context.job.links.figures}/basin-stability.svg`),
      element("p", {}, `${short(ended, 7)} of ${short(points, 7)} points are computed.`),
      attractors.length > 0 && attractorTable(attractors),
      along && byValue(along, attractors)));
  });
}

async function figure(path) {
  return element("img", {
    class: "figure", alt: "How many starts end on each attractor",
    src: await openAddress(path, true), onload: ({ target }) => URL.revokeObjectURL(target.src),
  });
}

function byValue({ parameter, unit, values }, attractors) {
  return table(`Shares over ${parameter}`, [parameter, ...attractors.map(({ name }) => name)],
    values.map((value, i) => [withUnit(value, unit, 5), ...attractors.map(({ shares, share_errors: errors }) =>
      shares[i] === null ? "" : share(shares[i], errors[i]))]), "small");
}

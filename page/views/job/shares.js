/** Basin stability: how many of the drawn starts end on each attractor, and that over a parameter. */

import { attractorTable, share } from "../../charts/attractors.js";
import { element, fill } from "../../interface/element.js";
import { freshFigure } from "../../interface/fresh_figure.js";
import { short, withUnit } from "../../interface/numbers.js";
import { table } from "../../interface/table.js";
import { whenThere } from "../../interface/when_there.js";

export async function show(room, context) {
  await whenThere(room, context, context.job.links.attractors, {}, async (answer) => {
    const { attractors, along, ended, points } = answer;
    fill(room, element("section", { class: "panel stacked" },
      attractors.length > 0 && await freshFigure(
        `${context.job.links.figures}/basin-stability.svg`, "How many starts end on each attractor"),
      element("p", {}, `${short(ended, 7)} of ${short(points, 7)} points are computed.`),
      attractors.length > 0 && attractorTable(attractors),
      along && byValue(along, attractors)));
  });
}

function byValue({ parameter, unit, values }, attractors) {
  return table(`Shares over ${parameter}`, [parameter, ...attractors.map(({ name }) => name)],
    values.map((value, i) => [withUnit(value, unit, 5), ...attractors.map(({ shares, share_errors: errors }) =>
      shares[i] === null ? "" : share(shares[i], errors[i]))]), "small");
}

/** Branches of periodic orbits: drawn by the service, with a table of their special orbits. */

import { element, fill } from "../../interface/element.js";
import { freshFigure } from "../../interface/fresh_figure.js";
import { withUnit } from "../../interface/numbers.js";
import { table } from "../../interface/table.js";
import { whenThere } from "../../interface/when_there.js";

export async function show(room, context) {
  await whenThere(room, context, context.job.links.branch, {}, async (answer) => {
    const found = answer.branches.filter(({ special }) => special.length);
    const words = answer.branches.map(({ failure }) => failure?.detail).filter(Boolean);
    if (!found.length && !words.length) words.push("No orbit has been found yet.");
    fill(room, element("section", { class: "panel stacked" },
      found.length > 0 && await freshFigure(
        `${context.job.links.figures}/branch.svg`, `Branches of periodic orbits over ${answer.parameter}`),
      words.map((sentence) => element("p", {}, sentence)),
      found.length > 0 && specialOrbits(answer, found)));
  });
}

function specialOrbits({ parameter, unit }, branches) {
  const rows = branches.flatMap(({ index, special }) => special.map(({ label, value, bound, note }) => [
    `${label}, branch ${index}`, withUnit(value, unit, 10), bound ? withUnit(bound, unit, 2) : "", note,
  ]));
  return table("Special orbits", ["Orbit", parameter, "±", "there"], rows, "small");
}

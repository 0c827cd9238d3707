/** Branches of periodic orbits: drawn by the service, with a table of their special orbits. */

import { element, fill } from "../../interface/element.js";
import { freshFigure } from "../../interface/fresh_figure.js";
import { short, withUnit } from "../../interface/numbers.js";
import { offer } from "../../interface/point_of_study.js";
import { table } from "../../interface/table.js";
import { whenThere } from "../../interface/when_there.js";

const SECTION = /^(state|rate|impact_rate)\./;
const MULTIPLIER = /^multiplier_\d+\.real$/;

export async function show(room, context) {
  const chosen = element("div", { role: "status" });
  await whenThere(room, context, context.job.links.branch, {}, async (answer) => {
    const found = answer.branches.filter(({ special }) => special.length);
    const words = answer.branches.map(({ failure }) => failure?.detail).filter(Boolean);
    if (!found.length && !words.length) words.push("No orbit has been found yet.");
    const drawn = (name, alt) => freshFigure(`${context.job.links.figures}/${name}.svg`, alt);
    fill(room, element("section", { class: "panel stacked" },
      found.length > 0 && await drawn("branch", `Branches of periodic orbits over ${answer.parameter}`),
      words.map((sentence) => element("p", {}, sentence)),
      found.length > 0 && specialOrbits(answer, found, (branch, orbit) =>
        tell(chosen, context.job, answer, branch, orbit)),
      chosen,
      found.length > 0 && await drawn("multipliers", "Multipliers of the orbits in the complex plane")));
  });
}

function specialOrbits({ parameter, unit }, branches, pick) {
  const rows = branches.flatMap((branch) => branch.special.map((orbit) => [
    element("button", { type: "button", class: "quiet", onclick: () => pick(branch, orbit) },
      `${orbit.label}, branch ${branch.index}`),
    withUnit(orbit.value, unit, 10), orbit.bound ? withUnit(orbit.bound, unit, 2) : "", orbit.note,
  ]));
  return table("Special orbits", ["Orbit", parameter, "±", "there"], rows, "small");
}

/** Tells of an orbit, and offers the simulation that starts on it: its section is the state at time 0. */
function tell(room, job, { parameter, unit }, { columns }, { row, note }) {
  const at = (name) => columns[name].values[row];
  const multipliers = Object.keys(columns).filter((name) => MULTIPLIER.test(name)).map((name) =>
    complex(at(name), at(name.replace("real", "imaginary"))));
  const words = `${note}; ${at("unstable") ? `${at("unstable")} unstable` : "stable"}, ${at("impacts")} impacts a period, `
    + `multipliers ${multipliers.join(", ")}`;
  const state = Object.keys(columns).filter((name) => SECTION.test(name)).map(at);
  offer(room, job, { [parameter]: [at("value"), unit] }, words, "", {}, state);
}

function complex(real, imaginary) {
  if (!imaginary) return short(real, 4);
  return `${short(real, 4)} ${imaginary < 0 ? "−" : "+"} ${short(Math.abs(imaginary), 4)}i`;
}

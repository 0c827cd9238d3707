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
      found.some(({ of }) => of)
        && await drawn("curves", `Special orbits over ${answer.parameter} and ${answer.second}`),
      words.map((sentence) => element("p", {}, sentence)),
      found.length > 0 && specialOrbits(answer, found, (branch, orbit) =>
        tell(chosen, context.job, answer, branch, orbit)),
      chosen,
      found.length > 0 && await drawn("multipliers", "Multipliers of the orbits in the complex plane")));
  });
}

function specialOrbits({ parameter, unit, second, second_unit }, branches, pick) {
  const shown = (value, error, its) => [withUnit(value, its, 10), error ? withUnit(error, its, 2) : ""];
  const rows = branches.flatMap((branch) => branch.special.map((orbit) => [
    element("button", { type: "button", class: "quiet", onclick: () => pick(branch, orbit) },
      `${orbit.label}, ${branch.of ? "curve" : "branch"} ${branch.index}`),
    ...shown(orbit.value, orbit.bound, unit),
    ...(second ? shown(orbit.second, orbit.second_bound, second_unit) : []), orbit.note,
  ]));
  const names = second ? [parameter, "±", second, "±"] : [parameter, "±"];
  return table("Special orbits", ["Orbit", ...names, "there"], rows, "small");
}

/** Tells of an orbit, and offers the simulation that starts on it: its section is the state at time 0. */
function tell(room, job, { parameter, unit, second, second_unit }, { columns }, { row, note }) {
  const at = (name) => columns[name].values[row];
  const multipliers = Object.keys(columns).filter((name) => MULTIPLIER.test(name)).map((name) =>
    complex(at(name), at(name.replace("real", "imaginary"))));
  const words = `${note}; ${at("unstable") ? `${at("unstable")} unstable` : "stable"}, ${at("impacts")} impacts a period, `
    + `multipliers ${multipliers.join(", ")}`;
  const state = Object.keys(columns).filter((name) => SECTION.test(name)).map(at);
  const others = second ? { [second]: [at("second"), second_unit] } : {};
  offer(room, job, { [parameter]: [at("value"), unit], ...others }, words, "", {}, state);
}

function complex(real, imaginary) {
  if (!imaginary) return short(real, 4);
  return `${short(real, 4)} ${imaginary < 0 ? "−" : "+"} ${short(Math.abs(imaginary), 4)}i`;
}

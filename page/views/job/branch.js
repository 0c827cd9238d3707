/** Branches of periodic orbits: drawn by the service, with a table of their special orbits. */

import { button } from "../../interface/button.js";
import { element, fill, refill } from "../../interface/element.js";
import { freshFigure } from "../../interface/fresh_figure.js";
import { short, withUnit } from "../../interface/numbers.js";
import { offer } from "../../interface/point_of_study.js";
import { sceneName } from "../../interface/state.js";
import { table } from "../../interface/table.js";
import { whenThere } from "../../interface/when_there.js";
import { get } from "../../requests/service.js";

const SECTION = /^(state|rate|impact_rate)\./;
const KINDS_BENEATH = ["bifurcation", "chart", "basins"];
const MULTIPLIER = /^multiplier_\d+\.real$/;

export async function show(room, context) {
  const chosen = element("div", { role: "status" });
  const beneath = new Beneath(context);
  await whenThere(room, context, context.job.links.branch, {}, async (answer) => {
    const found = answer.branches.filter(({ special }) => special.length);
    const words = [...new Set(answer.branches.map(({ failure }) => failure?.detail).filter(Boolean))];
    if (!found.length && !words.length) words.push("No orbit has been found yet.");
    const drawn = (name, alt, query = "") => freshFigure(`${context.job.links.figures}/${name}.svg${query}`, alt);
    const pictures = element("div", { class: "stacked" });
    const draw = async () => fill(pictures,
      await drawn("branch", `Branches of periodic orbits over ${answer.parameter}`, beneath.query("branch")),
      found.some(({ of }) => of)
        && await drawn("curves", `Special orbits over ${answer.parameter} and ${answer.second}`, beneath.query("curves")));
    if (found.length) await Promise.all([beneath.offer(answer, draw), draw()]);
    refill(room, element("section", { class: "panel stacked" },
      beneath.element, pictures,
      words.map((sentence) => element("p", {}, sentence)),
      found.length > 0 && specialOrbits(answer, found, (branch, orbit) =>
        tell(chosen, context.job, answer, branch, orbit)),
      chosen,
      found.length > 0 && await drawn("multipliers", "Multipliers of the orbits in the complex plane")));
  });
}

/** The finished diagram or chart over the same parameters that branches and curves are drawn over. */
class Beneath {
  constructor({ job, signal }) {
    Object.assign(this, { job, signal, chosen: null });
    this.element = element("div", { class: "filters" });
    this.said = element("p", { role: "status" });
  }

  /** Offers what fits, once: it stays as the branch grows. */
  async offer({ parameter, second }, draw) {
    this.draw = draw;
    if (this.select) return;
    const wanted = [parameter, second].filter(Boolean);
    const lists = await Promise.all(KINDS_BENEATH.map((kind) =>
      get("/v1/jobs", { kind, state: "succeeded", page_size: 50 }, this.signal)));
    const others = lists.flatMap(({ jobs }) => jobs).filter(({ job }) => fits(job, wanted)
      && sceneName(job) === sceneName(this.job.job));
    this.select = element("select", { id: "beneath", onchange: () => {
      this.chosen = others.find(({ id }) => id === this.select.value) ?? null;
      fill(this.said);
      this.draw().catch((error) => fill(this.said, error.message));
    } }, element("option", { value: "" }, "nothing"), others.map(({ id, kind, label, created }) =>
      element("option", { value: id }, `${label || kind} · ${new Date(created).toLocaleString()}`)));
    if (!others.length) return;
    fill(this.element, element("div", { class: "field" },
      element("label", { for: "beneath" }, "Draw over"), this.select), this.said);
  }

  /** Returns the query of a figure; curves are drawn over charts alone. */
  query(figure) {
    const { id, kind } = this.chosen ?? {};
    return id && (figure === "branch" || kind !== "bifurcation") ? `?over=${id}` : "";
  }
}

function fits({ parameter, along, by }, wanted) {
  if (parameter) return parameter === wanted[0];
  return wanted.every((name) => [along, by].some((axis) => axis.parameter === name));
}

function specialOrbits({ parameter, unit, second, second_unit }, branches, pick) {
  const shown = (value, error, its) => [withUnit(value, its, 10), error ? withUnit(error, its, 2) : ""];
  const rows = branches.flatMap((branch) => branch.special.map((orbit) => [
    button(`${orbit.label}, ${branch.of ? "curve" : "branch"} ${branch.index}`, () => pick(branch, orbit), { class: "quiet" }),
    ...shown(orbit.value, orbit.bound, unit),
    ...(second ? shown(orbit.second, orbit.second_bound, second_unit) : []), orbit.note,
  ]));
  const names = second ? [parameter, "±", second, "±"] : [parameter, "±"];
  return table("Special orbits", ["Orbit", ...names, "there"], rows, "small explained");
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

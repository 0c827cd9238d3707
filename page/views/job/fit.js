/** What a calibration found: parameters with their spread, every target, the course of the search. */

import { element, fill } from "../../interface/element.js";
import { freshFigure } from "../../interface/fresh_figure.js";
import { short, withUnit } from "../../interface/numbers.js";
import { table } from "../../interface/table.js";
import { whenThere } from "../../interface/when_there.js";

export async function show(room, context) {
  const { links } = context.job;
  await whenThere(room, context, links.calibration, {}, async (found) => {
    const search = element("section", { class: "panel" }, element("h2", {}, "The search"));
    fill(room, element("div", { class: "split" },
      element("section", { class: "panel" }, element("h2", {}, "What fits"),
        element("p", {}, words(found)), parameters(found),
        element("h2", { class: "later" }, "What is met"), targets(found)),
      search));
    search.append(await freshFigure(`${links.figures}/calibration.svg`,
      "Lowest cost over the generations, and the miss of every target")); // the numbers are there before
  }, ["succeeded"]);
}

function words({ cost, equally_good_cost: limit, misfits, search }) {
  const nothing = misfits ? " Nothing fits: these misses are larger than errors of the tolerances’ size"
    + " explain. The model, a tolerance or the range of a parameter is not right." : "";
  const end = search.settled ? "" : " It ended before its candidates had become alike: more"
    + " generations may find better.";
  const reach = search.spread_settled === false ? " More may fit equally well than the ranges"
    + " tell: ask for more generations of the spread." : "";
  return `Cost ${short(cost, 3)}, the root mean square of the misses in tolerances; up to`
    + ` ${short(limit, 3)} fits equally well. ${search.candidates} candidates were tried.${nothing}${end}${reach}`;
}

function parameters({ parameters: found }) {
  return table("Parameters", ["Parameter", "Best", "5 % to 95 %", "No end at"], found.map((one) => [
    one.name, withUnit(one.best, one.unit, 4),
    `${short(one.quantiles["0.05"], 3)} … ${short(one.quantiles["0.95"], 3)}`,
    one.open_ends.join(", ") || "–",
  ]), "small");
}

function targets({ targets: found }) {
  const several = new Set(found.map((one) => one.case)).size > 1;
  return table("Targets", ["Target", "Wanted", "Found", "Miss"], found.map((one) => [
    [several && one.case, `${one.statistic.replaceAll("_", " ")} of ${one.channel}`].filter(Boolean).join(", "),
    one.between ? one.between.map((end) => end ?? "").join(" … ") : withUnit(one.value, one.unit, 4),
    one.fitted === null ? "–" : withUnit(one.fitted, one.unit, 4),
    one.miss === null ? "–" : short(one.miss, 2),
  ]), "small");
}

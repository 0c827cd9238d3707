/** What a calibration found: parameters with their spread, every target, the course of the search. */

import { element, fill } from "../../interface/element.js";
import { short, withUnit } from "../../interface/numbers.js";
import { openAddress } from "../../requests/key.js";
import { whenThere } from "../../interface/when_there.js";

export async function show(room, context) {
  const { links } = context.job;
  await whenThere(room, context, links.calibration, {}, (found) =>
    fill(room, element("div", { class: "split" },
      element("section", { class: "panel" }, element("h2", {}, "What fits"),
        element("p", {}, words(found)), parameters(found), targets(found)),
      element("section", { class: "panel" }, element("h2", {}, "The search"),
        figure(`${links.figures}/calibration.svg`)))));
}

function words({ cost, equally_good_cost: limit, search }) {
  const end = search.settled ? "" : " It ended before its candidates had become alike: more"
    + " generations may find better.";
  return `Cost ${short(cost, 3)}, the root mean square of the misses in tolerances; up to`
    + ` ${short(limit, 3)} fits equally well. ${search.candidates} candidates were tried.${end}`;
}

function parameters({ parameters: found }) {
  return table(["Parameter", "Best", "5 % to 95 %", "No end at"], found.map((one) => [
    one.name, withUnit(one.best, one.unit, 4),
    `${short(one.quantiles["0.05"], 3)} … ${short(one.quantiles["0.95"], 3)}`,
    one.open_ends.join(", ") || "–",
  ]));
}

function targets({ targets: found }) {
  return table(["Target", "Wanted", "Found", "Miss"], found.map((one) => [
    [one.case, `${one.statistic.replaceAll("_", " ")} of ${one.channel}`].filter(Boolean).join(", "),
    one.between ? one.between.map((end) => end ?? "").join(" … ") : withUnit(one.value, one.unit, 4),
    one.fitted === null ? "–" : withUnit(one.fitted, one.unit, 4),
    one.miss === null ? "–" : short(one.miss, 2),
  ]));
}

function table(titles, rows) {
  const label = titles[0];
  return element("div", { class: "wide", tabindex: "0", role: "group", "aria-label": label },
    element("table", { class: "small" },
      element("thead", {}, element("tr", {}, titles.map((title, i) =>
        element("th", { scope: "col", class: i ? "number" : "" }, title)))),
      element("tbody", {}, rows.map(([name, ...cells]) => element("tr", {},
        element("th", { scope: "row" }, name),
        cells.map((cell) => element("td", { class: "number" }, cell)))))));
}

function figure(path) {
  const alt = "Lowest cost over the generations, and the miss of every target";
  const image = element("img", { class: "figure", alt });
  openAddress(path).then((address) => (image.src = address));
  return image;
}

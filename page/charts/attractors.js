/** The attractors that many starts end on, as a table, and the boundary of a map of basins. */

import { element } from "../interface/element.js";
import { short } from "../interface/numbers.js";

/** Returns a share with its standard error, both between 0 and 1, in words. */
export function share(value, error) {
  return `${short(100 * value, 4)} ± ${short(100 * error, 2)} %`;
}

/** Returns the table of the attractors of an answer of the service, below it the boundary of a map. */
export function mapOfAttractors({ attractors, boundary }) {
  return element("div", {}, attractorTable(attractors),
    element("p", { class: "quiet small" }, boundary === null
      ? "Too few points lie beside a boundary to tell its dimension, or basins are a few points wide."
      : `The boundary between the basins has the dimension ${boundary.dimension.toFixed(2)} ± ${
        boundary.error.toFixed(2)}.`));
}

/** Returns the table of attractors: points, shares, exponents. */
export function attractorTable(attractors) {
  const rows = attractors.map((one) => element("tr", {},
    element("th", { scope: "row" }, swatch(one.colour), ` ${one.name}`),
    element("td", {}, short(one.points, 7)),
    element("td", {}, share(one.share, one.share_error)),
    element("td", {}, one.lyapunov === null ? "" : `${short(one.lyapunov, 3)} ± ${short(one.lyapunov_error, 2)}`)));
  return element("table", {},
    element("thead", {}, element("tr", {},
      ["Attractor", "Points", "Share", "Exponent (1/s)"].map((title) => element("th", { scope: "col" }, title)))),
    element("tbody", {}, rows));
}

function swatch(colour) {
  const made = element("span", { class: "swatch" });
  made.style.background = colour;
  return made;
}

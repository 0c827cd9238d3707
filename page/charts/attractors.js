/** The attractors of a map of basins, as a table, with the dimension of the boundary. */

import { element } from "../interface/element.js";
import { short } from "../interface/numbers.js";

/** Returns the table of an answer of the service. */
export function attractorTable({ attractors, boundary }) {
  const rows = attractors.map((one) => element("tr", {},
    element("th", { scope: "row" }, swatch(one.colour), ` ${one.name}`),
    element("td", {}, short(one.points, 7)),
    element("td", {}, `${short(100 * one.share, 4)} ± ${short(100 * one.share_error, 2)} %`),
    element("td", {}, one.lyapunov === null ? "" : `${short(one.lyapunov, 3)} ± ${short(one.lyapunov_error, 2)}`)));
  return element("div", {},
    element("table", {},
      element("thead", {}, element("tr", {},
        ["Attractor", "Points", "Share", "Exponent (1/s)"].map((title) => element("th", { scope: "col" }, title)))),
      element("tbody", {}, rows)),
    element("p", { class: "quiet small" }, boundary === null
      ? "Too few points lie beside a boundary to tell its dimension."
      : `The boundary between the basins has the dimension ${boundary.dimension.toFixed(2)} ± ${
        boundary.error.toFixed(2)}.`));
}

function swatch(colour) {
  const made = element("span", { class: "swatch" });
  made.style.background = colour;
  return made;
}

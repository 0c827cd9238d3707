/** The attractors that many starts end on, as a table, and the boundary of a map of basins. */

import { element } from "../interface/element.js";
import { short, withError } from "../interface/numbers.js";
import { tableOf } from "../interface/table.js";

/** Returns a share with its standard error, both between 0 and 1, in words. */
export function share(value, error) {
  return `${withError(100 * value, 100 * error)} %`;
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
  const judged = attractors.some(({ lyapunov }) => lyapunov !== null);
  const rows = attractors.map((one) => [
    [swatch(one.colour), ` ${one.name}`], short(one.points, 7), share(one.share, one.share_error),
    ...(judged ? [one.lyapunov === null ? "" : withError(one.lyapunov, one.lyapunov_error)] : []),
  ]);
  return tableOf("Attractors", ["Attractor", "Points", "Share", ...(judged ? ["Exponent (1/s)"] : [])], rows);
}

function swatch(colour) {
  const made = element("span", { class: "swatch" });
  made.style.background = colour;
  return made;
}

/** Tables: a scroll of their own where they are too wide; of numbers, with a name for each row. */

import { element } from "./element.js";

/** Returns a name that may go on in the next line after each of its parts. */
function breakable(name) {
  return typeof name !== "string" ? name
    : name.split(/(?<=[._])/).map((part) => [part, element("wbr")]);
}

/**
 * Returns a table.
 *
 * @param label what a screen reader calls it
 * @param titles of the columns, or their cells
 * @param rows its `tr`, or lists of cells: the first of a list names it
 * @param look classes of the table
 */
export function tableOf(label, titles, rows, look = "") {
  const head = (title) => (typeof title === "string" ? element("th", { scope: "col" }, title) : title);
  const row = ([name, ...cells]) => element("tr", {},
    element("th", { scope: "row" }, name), cells.map((cell) => element("td", {}, cell)));
  return element("div", { class: "wide", tabindex: "0", role: "group", "aria-label": label },
    element("table", { class: look },
      element("thead", {}, element("tr", {}, titles.map(head))),
      element("tbody", {}, rows.map((one) => (Array.isArray(one) ? row(one) : one)))));
}

/**
 * Returns a table whose first column names its rows.
 *
 * @param label what a screen reader calls it
 * @param titles of the columns
 * @param rows lists of cells, as long as `titles`
 * @param look classes of the table; `explained`: its last column has sentences
 */
export function table(label, titles, rows, look = "") {
  return tableOf(label, titles.map((title, i) => element("th", { scope: "col", class: i ? "number" : "" }, title)),
    rows.map(([name, ...cells]) => element("tr", {},
      element("th", { scope: "row" }, breakable(name)),
      cells.map((cell) => element("td", { class: "number" }, cell)))), look);
}

/** The filters of a list of jobs. */

import { element } from "./element.js";

const STATES = ["queued", "running", "cancelling", "succeeded", "failed", "cancelled"];

/**
 * Returns the form of the filters `{state, kind, scene, label}`.
 *
 * @param kinds names
 * @param chosen called with a filter's name and its new value
 * @param more what else stands in the form
 */
export function jobFilters(filters, kinds, chosen, more) {
  const field = (name, title, control) => element("div", { class: "field" },
    element("label", { for: `filter-${name}` }, title), control);
  const select = (name, title, values) => field(name, title, element("select", {
    id: `filter-${name}`, onchange: (event) => chosen(name, event.target.value),
  }, ["", ...values].map((value) => element("option", {
    value, selected: value === filters[name],
  }, value || "all"))));
  const text = (name, title) => field(name, title, element("input", {
    type: "search", id: `filter-${name}`, value: filters[name], maxlength: 200,
    onchange: (event) => chosen(name, event.target.value.trim()),
  }));
  return element("div", { class: "filters", role: "search" },
    select("state", "State", STATES), select("kind", "Kind", kinds),
    text("scene", "Mechanism"), text("label", "Label"), more);
}

/** Every field that a scene may have, as its JSON Schema describes it: a list that can be searched. */

import { element, fill } from "../interface/element.js";
import { rangeWords } from "./schema.js";

/** Returns a part of the page, closed at first; it is filled when it is opened. */
export function fieldList(schema) {
  const found = element("div", { class: "wide", tabindex: "0", role: "group", "aria-label": "Fields" });
  const search = element("input", {
    type: "search", "aria-label": "Find a field", placeholder: "Find a field", oninput: () => show(),
  });
  const parts = [["scene", schema], ...Object.entries(schema.$defs ?? {})];
  const show = () => fill(found, parts.map(([name, one]) => part(name, one, search.value.trim().toLowerCase())));
  return element("details", { class: "panel", ontoggle: ({ target }) => target.open && show() },
    element("summary", {}, "Every field of a scene"),
    element("div", { class: "stacked" }, search, found));
}

/** Returns what an object has, or null if nothing of it is looked for. */
function part(name, { description = "", properties = {}, required = [] }, wanted) {
  const whole = `${name} ${description}`.toLowerCase().includes(wanted);
  const rows = Object.entries(properties).filter(([field, one]) =>
    whole || `${field} ${one.description ?? ""}`.toLowerCase().includes(wanted));
  if (!rows.length) return null;
  return [
    element("h2", { class: "later" }, name),
    element("p", { class: "quiet small" }, description),
    element("table", { class: "small listing" }, element("tbody", {}, rows.map(([field, one]) =>
      element("tr", {},
        element("th", { scope: "row" }, element("code", {}, field)),
        element("td", { class: "quiet" }, words(one, required.includes(field))),
        element("td", {}, one.description ?? ""))))),
  ];
}

/** Returns type, range, unit and default; a field that may be null is told as if it could not. */
function words(one, required) {
  const kinds = [one, ...(one.anyOf ?? []), ...(one.oneOf ?? [])];
  const named = kinds.flatMap(({ $ref, const: value, enum: values }) =>
    [$ref?.split("/").at(-1), value, ...(values ?? [])]).filter((word) => word !== undefined);
  const range = kinds.map(rangeWords).find(Boolean) ?? kinds.map(({ type }) => type).find(Boolean) ?? "";
  return [required && "required", named.length ? named.join(" or ") : range].filter(Boolean).join(", ");
}

/** The form of a kind of job, made of what the service says of its fields. */

import { accuracyOf, accurate } from "./accuracy.js";
import { DrawnParameters, NONE } from "./drawn_parameters.js";
import { fades, sectionFields, sectionGiven, sectionMade } from "./section_fields.js";

/** Fields that other parts of the form ask for, or whose values nobody types. */
const ELSEWHERE = new Set(["label", "tolerance", "method", "step", "formulation"]);
const TYPED = new Set(["number", "integer"]);
const OF_PARAMETERS = new Set(["axis", "distributions"]);
const DURATION = "duration"; // which periods stand for
const ACCURACY = "accuracy"; // also a tolerance
const SETTLE = "settle";
const RECORD = "record"; // sections, one in each period if they are taken so

/**
 * Returns the title and help of a kind, its fields, the parts of the document that are made of their
 * values, and the values that a document gives; as the kinds that are written here.
 *
 * @param described what `/v1/kinds` says of it
 * @param axis      makes the fields of a parameter that varies, and of its values
 * @param choice    makes the field of a parameter
 * @param proposed  gives a range of its values
 */
export function formOfKind(name, described, { axis, ends, choice, proposed }) {
  const shown = Object.entries(described.fields).filter(([field, { form, choices }]) =>
    !ELSEWHERE.has(field) && (OF_PARAMETERS.has(form) || TYPED.has(form) || (form === "text" && choices.length)));
  const axes = shown.filter(([, { form }]) => form === "axis").map(([field]) => field);
  const own = described.option?.form === "values"; // a parameter and its values are fields themselves
  const drawn = shown.filter(([, { form }]) => form === "distributions")
    .map(([field, one]) => new DrawnParameters(field, one, choice, proposed));
  const others = shown.filter(([, { form }]) => !OF_PARAMETERS.has(form));
  const { section } = described.fields;
  return {
    title: TITLES[name] ?? titled(name),
    help: described.help,
    fields: (document, { duration, sections }) => Object.assign(
      {},
      ...drawn.map((one) => one.fields(document)),
      own ? axis(document, "parameter", "Parameter", {
        ...inWords(described.fields.parameter), counted: sentence(described.fields.values.help),
      }, 0, "") : {},
      ...axes.map((field, nth) =>
        axis(document, field, titled(field), inWords(described.fields[field]), nth + Number(own))),
      Object.fromEntries(others.map(([field, one]) => [field, ofField(field, one, {
        duration, settle: section?.members.onset && fades(document, sections) ? 0 : null,
        units: choice(document).units,
      })])),
      section && sectionFields(section, sections),
    ),
    made: (all) => ({
      ...Object.fromEntries(drawn.map((one) => [one.field, one.made(all)])),
      ...(own ? { parameter: all.parameter, values: { from: all.from, to: all.to, count: all.count } } : {}),
      ...Object.fromEntries(axes.filter((field) => all[field] !== NONE).map((field) => [field, {
        [isStart(all[field]) ? "start" : "parameter"]: all[field],
        values: { from: all[`${field}_from`], to: all[`${field}_to`], count: all[`${field}_count`] },
      }])),
      ...Object.fromEntries(others.map(([field]) => [field, all[field]])
        .filter(([field, value]) => value !== null && value !== STANDARD && field !== ACCURACY
          && (field !== DURATION || !all.periods))),
      ...sectionMade(all),
      ...accurate(all[ACCURACY]),
    }),
    given: (document) => Object.assign(
      {},
      ...drawn.map((one) => one.given(document[one.field])),
      own ? { parameter: document.parameter, ...ends(document.values) } : {},
      ...axes.filter((field) => document[field]).map((field) => ({
        [field]: document[field].parameter ?? document[field].start,
        ...Object.fromEntries(Object.entries(ends(document[field].values))
          .map(([part, value]) => [`${field}_${part}`, value])),
      })),
      Object.fromEntries(others.map(([field]) => [field, field === ACCURACY ? accuracyOf(document) : document[field]])
        .filter(([, value]) => value !== undefined && value !== null)),
      sectionGiven(document.section),
    ),
  };
}

const STANDARD = "as usual";
const OF_PARAMETER = "the parameter's unit";
const TITLES = { poincare: "Poincaré sections" };

const MEMBERS = /: \{'[^}]*\}$/; // of an object in a document: a form has fields for them

/** Whether what varies is a number of the start, by its JSON pointer. */
function isStart(name) {
  return name.startsWith("/");
}

function inWords(described) {
  return { ...described, help: sentence(described.help) };
}

function ofField(name, { help, unit, choices, required, words, form }, proposed) {
  const shown = { title: titled(name), help: sentence(help), unit: unit ?? "1", accepts: words, whole: form === "integer" };
  if (choices.length) return { ...shown, choices: [STANDARD, ...choices], default: STANDARD };
  if (name === DURATION) return { ...shown, default: proposed.duration };
  if (unit === OF_PARAMETER) shown.unit = ({ parameter }) => proposed.units[parameter] ?? "1";
  if (name === RECORD && unit === "periods") shown.unit = ({ section }) => (section === "crank_angle" ? unit : "sections");
  const value = name === SETTLE ? proposed.settle : null;
  return { ...shown, default: value, empty: String(value ?? STANDARD), required };
}

function titled(name) {
  const words = name.replaceAll(/[_-]/g, " ");
  return words[0].toUpperCase() + words.slice(1);
}

function sentence(text) {
  const words = text?.replace(MEMBERS, "");
  return words ? `${words[0].toUpperCase()}${words.slice(1)}.` : "";
}

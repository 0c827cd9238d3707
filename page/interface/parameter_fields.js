/** A form made of a scene's declared parameters: units, ranges, help. */

import { NONE } from "./drawn_parameters.js";
import { element } from "./element.js";
import { NO_NUMBER, short, typed, unitText } from "./numbers.js";

const SHOWN = 6; // others are folded away

/**
 * Fields of declared parameters; those of a kind of job, whose place is "", are all shown.
 *
 * A unit or a help may be a function of the values of all fields: the unit of a range is its parameter's.
 * So may be the `pointer` to its place in the document, and whether a field is `shown`; what is hidden is
 * never wrong. Of choices with the same `once` none may be made twice: the document has each by its name.
 *
 * Of a declared parameter with choices there is no other value; a form shows what a job had, whatever it was.
 *
 * @property element   the form's part
 * @property values()  what differs from the defaults; throws where something is wrong
 */
export class ParameterFields {
  constructor(parameters, given = {}, onchange = () => {}, place = "/scene/parameters") {
    this.place = place;
    this.fields = Object.entries(parameters).map(([name, parameter]) =>
      new Field(name, { ...parameter, isDeclared: place !== "" }, given[name], () => {
        this.propose(name);
        this.tell();
        onchange();
      }, `${place.replaceAll("/", "-")}-${name}`));
    const required = this.fields.filter(({ parameter }) => parameter.required);
    const rare = place === "" ? [] : required.length
      ? this.fields.filter((one) => !required.includes(one))
      : this.fields.slice(SHOWN);
    const [first, rest] = [this.fields.filter((one) => !rare.includes(one)), rare];
    this.element = element(
      "div",
      { class: "stacked" },
      element("div", { class: "fields" }, first.map((one) => one.element)),
      rest.length > 0 && element(
        "details",
        { open: rest.some((one) => given[one.name] !== undefined) },
        element("summary", {}, `${rest.length} more ${rest.length === 1 ? "parameter" : "parameters"}`),
        element("div", { class: "fields" }, rest.map((one) => one.element)),
      ),
    );
    for (const { name } of this.fields.filter((one) => given[one.name] !== undefined)) this.propose(name, given);
    this.tell();
  }

  tell() {
    const all = this.all();
    for (const field of this.fields) field.tell(all);
    this.tellTwice();
  }

  /** Complains of what is chosen twice; returns whether nothing is. */
  tellTwice() {
    const choices = this.fields.filter(({ parameter, element: { hidden } }) => parameter.once && !hidden);
    const twice = (one) => one.input.value !== NONE && choices.some((other) => other !== one
      && other.parameter.once === one.parameter.once && other.input.value === one.input.value);
    for (const one of choices) one.complain(twice(one) ? "It is named twice." : "");
    return !choices.some(twice);
  }

  /** Shows in other fields what the choice in one proposes for them, but not in those that are given. */
  propose(name, given = {}) {
    const { parameter, input } = this.fields.find((one) => one.name === name);
    for (const [other, value] of Object.entries(parameter.proposes?.(input.value) ?? {})) {
      if (given[other] === undefined) this.fields.find((one) => one.name === other).show(value);
    }
  }

  /** Returns what was given, typed or chosen, as it stands in the fields; the rest was proposed. */
  given() {
    const own = this.fields.filter(({ isProposed }) => !isProposed);
    return Object.fromEntries(own.map(({ name, input }) => [name, input.value.trim()]));
  }

  get valid() {
    return [...this.fields.map((field) => field.check()), this.tellTwice()].every(Boolean);
  }

  values() {
    const given = this.fields.map((field) => [field.name, field.value()]);
    return Object.fromEntries(given.filter(([, value]) => value !== undefined));
  }

  /** Returns the value of every field, defaults too. */
  all() {
    return Object.fromEntries(this.fields.map((field) =>
      [field.name, field.value() ?? field.parameter.default]));
  }

  /** Shows what the service found wrong; returns the errors that belong to no field here. */
  blame(errors) {
    const all = this.all();
    const places = this.fields.map((field) => [field, placeOf(field, all)])
      .sort(([, one], [, other]) => other.length - one.length); // the narrowest first
    return errors.filter(({ pointer, detail }) => {
      const inside = pointer?.startsWith(`${this.place}/`);
      const within = inside ? pointer.slice(this.place.length + 1) : "";
      const [field] = places.find(([, place]) => place && `${within}/`.startsWith(`${place}/`))
        ?? places.find(([{ name }]) => name === within.split("/")[0]) ?? [];
      field?.complain(detail);
      return !field;
    });
  }
}

class Field {
  constructor(name, parameter, given, onchange, id) {
    Object.assign(this, { name, parameter, isProposed: given === undefined });
    const shown = given ?? parameter.default;
    const checked = () => {
      this.isProposed = false;
      this.check();
      onchange();
    };
    this.input = parameter.choices
      ? element(
          "select",
          { id, onchange: checked, "aria-describedby": `${id}-help ${id}-wrong` },
          [...new Set([...parameter.choices, shown])].map((one) => // what a job had may be none of them
            element("option", { value: one, selected: one === shown },
              parameter.words?.[one] ?? one)),
        )
      : element("input", {
          id,
          inputmode: "decimal",
          autocomplete: "off",
          value: written(shown),
          placeholder: parameter.required ? "required" : (parameter.empty ?? "as the scene says"),
          "aria-describedby": `${id}-help ${id}-wrong`,
          required: parameter.required,
          oninput: checked,
        });
    this.wrong = element("p", { class: "wrong", id: `${id}-wrong` });
    this.unit = element("span", { class: "unit" });
    this.help = element("span", {}, typeof parameter.help === "function" ? "" : parameter.help);
    this.element = element(
      "div",
      { class: "field" },
      element("label", { for: id }, parameter.title ?? name),
      element("div", { class: "entry" }, this.input, !parameter.choices && this.unit),
      element("p", { class: "help", id: `${id}-help` }, this.help, " ", range(parameter), orWords(parameter)),
      this.wrong,
    );
  }

  /** Returns the value that was chosen; undefined for the default. */
  value() {
    const text = this.input.value.trim();
    if (this.parameter.choices) return text === this.parameter.default ? undefined : text;
    if (text === "") return undefined;
    if (this.parameter.accepts?.includes(text)) return text;
    const value = typed(text);
    return value === this.parameter.default ? undefined : value;
  }

  /** Tells what depends on the values of all fields. */
  tell(all) {
    const { unit, help, shown } = this.parameter;
    if (typeof help === "function") this.help.textContent = help(all);
    this.element.hidden = shown?.(all) === false;
    const written = typeof unit === "function" ? unit(all) : unit;
    this.unit.textContent = written === "1" ? "" : unitText(written);
  }

  /** Shows a value that is not typed. */
  show(value) {
    this.isProposed = true;
    this.input.value = written(value);
    this.check();
  }

  check() {
    const { parameter } = this;
    const text = this.input.value.trim();
    let wrong = "";
    if (parameter.choices) {
      if (parameter.isDeclared && !parameter.choices.includes(text)) wrong = `It is one of ${parameter.choices.join(", ")}.`;
    } else if (!this.element.hidden) {
      const value = typed(text);
      const low = parameter.minimum ?? -Infinity;
      const high = parameter.maximum ?? Infinity;
      if (text === "") wrong = parameter.required ? "This has no default; give a value." : "";
      else if (parameter.accepts?.includes(text)) wrong = "";
      else if (Number.isNaN(value)) wrong = NO_NUMBER;
      else if (parameter.whole && !Number.isInteger(value)) wrong = "Give a whole number.";
      else if (value < low || value > high) wrong = `Allowed: ${range(parameter)}`;
    }
    this.complain(wrong);
    return wrong === "";
  }

  complain(sentence) {
    this.wrong.textContent = sentence;
    this.input.setAttribute("aria-invalid", String(sentence !== ""));
  }
}

/** Returns where in the part of the document a field's value is, if it is not by its name. */
function placeOf({ parameter: { pointer = "" } }, all) {
  return typeof pointer === "function" ? pointer(all) : pointer;
}

function written(value) {
  if (value === null || value === undefined) return "";
  const large = typeof value === "number" && Math.abs(value) >= 1e6;
  return large ? value.toExponential().replace("+", "") : String(value);
}

function orWords({ accepts }) {
  return accepts?.length ? ` Or: ${accepts.join(", ")}.` : "";
}

function range({ minimum, maximum, unit, choices }) {
  const [low, high] = [minimum, maximum].map((one) => one !== null && one !== undefined);
  if (choices || !(low || high)) return "";
  const of = unit === "1" || typeof unit !== "string" ? "" : ` ${unitText(unit)}`; // else it stands beside the field
  if (low && high) return `${short(minimum)} to ${short(maximum)}${of}.`;
  if (low) return `At least ${short(minimum)}${of}.`;
  return `At most ${short(maximum)}${of}.`;
}

/** The fields of a calibration: parameters to find with their ranges, and what was measured. */

import { button } from "./button.js";
import { element, fill } from "./element.js";
import { casesOf, linesOf } from "./measured_table.js";
import { typed } from "./numbers.js";
import { ParameterRange, rangeIn } from "./parameter_range.js";
import { withParameters } from "../mechanism/parameters.js";
import { play } from "../mechanism/placing.js";

/** Of its fields, as the address keeps them. */
export const NAMES = ["find", "measured", "generations"];
const MOST = 6; // parameters, as the service allows

/** Fields with the interface of `ParameterFields`; the address keeps them as `find` and `measured`. */
export class CalibrationFields {
  /** @param scene document of a preset, @param given `find`, `measured`, `generations` as texts */
  constructor(scene, given, onchange) {
    Object.assign(this, { scene, onchange, rows: [] });
    this.declared = Object.fromEntries(
      Object.entries(scene.parameters ?? {}).filter(([, { choices }]) => !choices));
    this.list = element("div", { class: "stacked" });
    this.more = button("Find another one", () => this.add(this.unused()[0]));
    this.text = element("textarea", {
      id: "measured", rows: 7, spellcheck: "false", value: String(given.measured ?? ""),
      placeholder: "channel,statistic,from,to,value,tolerance",
      "aria-describedby": "measured-help measured-wrong", oninput: () => this.changed(),
    });
    this.wrong = element("p", { class: "wrong", id: "measured-wrong" });
    this.generations = element("input", {
      id: "generations", inputmode: "numeric", value: String(given.generations ?? ""),
      placeholder: "60", oninput: () => this.changed(),
    });
    this.element = this.layout();
    const wanted = String(given.find ?? "").split(";").filter(Boolean).map(rangeIn)
      .filter(({ name }) => name in this.declared);
    for (const one of wanted.length ? wanted : [{ name: this.likely() }]) this.add(one.name, one);
    this.check();
  }

  layout() {
    const printed = reportedCases(this.scene);
    return element("div", { class: "stacked" },
      element("fieldset", {}, element("legend", {}, "Parameters to find"), this.list, this.more),
      element("div", { class: "field" }, element("label", { for: "measured" }, "What was measured"),
        this.text,
        element("p", { class: "help", id: "measured-help" }, "A table with a head, cells between"
          + " commas: channel, to [s] and value are needed, or lowest and highest in place of a value;"
          + " statistic (maximum, minimum, range, maximum_time, minimum_time), from [s], tolerance,"
          + " relative_tolerance, weight, sampled [s] and note may be there. A column named as a"
          + " parameter sets it: equal ones are one case."),
        this.wrong,
        printed.length > 0 && button("Take what the source printed", () => {
          this.text.value = linesOf(printed);
          this.changed();
        })),
      element("div", { class: "field" }, element("label", { for: "generations" }, "Generations"),
        this.generations,
        element("p", { class: "help" }, "Of the search, at most. More find better, and take longer.")));
  }

  likely() {
    const names = Object.keys(this.declared);
    const known = (name) => this.declared[name]?.default > 0; // a range about it can be proposed
    return ["stiffness", "restitution"].find(known) ?? names.find(known) ?? names[0];
  }

  unused() {
    return Object.keys(this.declared).filter((name) => !this.rows.some((row) => row.name === name));
  }

  add(name, given = {}) {
    if (name === undefined) return;
    const row = new ParameterRange(this.declared, name, given, () => this.changed(), () => {
      this.rows = this.rows.filter((one) => one !== row);
      this.listRows();
    });
    this.rows.push(row);
    this.listRows();
  }

  /** Shows the rows that there are by now: one that is shown again loses the keyboard. */
  listRows() {
    fill(this.list, this.rows.map((row) => row.element));
    this.changed();
  }

  changed() {
    this.more.hidden = this.rows.length >= MOST || !this.unused().length;
    for (const row of this.rows) row.removal.hidden = this.rows.length === 1;
    this.check();
    this.onchange();
  }

  check() {
    for (const row of this.rows) {
      const twice = this.rows.filter(({ name }) => name === row.name).length > 1;
      row.complain(twice ? "It is named twice." : row.trouble());
    }
    try {
      this.measured = casesOf(this.text.value, this.scene.parameters ?? {});
      this.complain("");
    } catch (error) {
      this.measured = null;
      this.complain(this.text.value.trim() ? error.message : "");
    }
  }

  complain(sentence) {
    this.wrong.textContent = sentence;
    this.text.setAttribute("aria-invalid", String(sentence !== ""));
  }

  get valid() {
    this.check();
    return this.measured !== null && this.rows.every((row) => row.trouble() === "");
  }

  /** Returns what is still to be given, if nothing is wrong. */
  get lacking() {
    return this.text.value.trim() ? null : "Give at least one measured number.";
  }

  /** Returns what the address keeps. */
  values() {
    return {
      find: this.rows.map((row) => row.text).join(";"), measured: this.text.value.trim(),
      generations: this.generations.value.trim(),
    };
  }

  /** Returns the parts of a calibration's document. */
  all() {
    const generations = typed(this.generations.value);
    return {
      parameters: Object.fromEntries(this.rows.map((row) => [row.name, row.bounds])),
      cases: this.measured.cases,
      ...(generations > 0 ? { search: { generations } } : {}),
    };
  }

  /** Shows what the service found wrong; returns the errors that belong to no field here. */
  blame(errors) {
    return errors.filter(({ pointer = "", detail }) => {
      const [, part, first, , second] = pointer.split("/");
      const row = part === "parameters" && this.rows.find(({ name }) => name === first);
      row?.complain?.(detail);
      const line = part === "cases" && (this.measured?.lines[first]?.[second] ?? this.measured?.lines[first]?.[0]);
      if (line) this.complain(`Line ${line}: ${detail}`);
      return !row && !line;
    });
  }
}

/** Returns what the scene's source printed as cases; those without any play are moved by nothing. */
function reportedCases(scene) {
  const cases = new Map();
  for (const { parameters = {}, channel, statistic, duration, value } of scene.reported ?? []) {
    const key = JSON.stringify(parameters);
    if (!cases.has(key)) cases.set(key, { parameters, targets: [] });
    cases.get(key).targets.push({ channel, statistic, to: duration, value });
  }
  return [...cases.values()].filter(({ parameters }) =>
    Object.values(withParameters(scene, parameters).joints ?? {}).some((joint) => play(joint) > 0));
}

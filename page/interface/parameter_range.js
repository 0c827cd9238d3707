/** The range in which a parameter is searched: its name, two numbers, and how they are spaced. */

import { button } from "./button.js";
import { element } from "./element.js";
import { short, typed, unitText } from "./numbers.js";

export class ParameterRange {
  /**
   * @param declared parameters to choose from
   * @param given `minimum`, `maximum` and `log` as texts, or none: a range is proposed
   */
  constructor(declared, name, { minimum, maximum, log }, onchange, onremove) {
    Object.assign(this, { declared });
    const id = `find-${Math.random().toString(36).slice(2)}`;
    const input = (title, value) => {
      const made = element("input", { id: `${id}-${title}`, inputmode: "decimal", value, oninput: onchange });
      return [made, element("div", { class: "field" }, element("label", { for: made.id }, title), made)];
    };
    this.select = element("select", { id: `${id}-name`, onchange: () => {
      this.suggest();
      onchange();
    } }, Object.keys(declared).map((one) => element("option", { value: one, selected: one === name }, one)));
    const [low, lowField] = input("From", minimum ?? "");
    const [high, highField] = input("To", maximum ?? "");
    this.log = element("input", { type: "checkbox", id: `${id}-log`, checked: Boolean(log), onchange });
    this.wrong = element("p", { class: "wrong" });
    this.removal = button("Leave out", onremove);
    this.unit = element("span", { class: "quiet small" });
    Object.assign(this, { low, high });
    this.element = element("div", {},
      element("div", { class: "range" },
        element("div", { class: "field" }, element("label", { for: `${id}-name` }, "Parameter"), this.select),
        lowField, highField,
        element("label", { class: "buttons small", for: `${id}-log` }, this.log, "equal ratios"),
        this.removal),
      this.unit, this.wrong);
    if (minimum === undefined) this.suggest();
    this.tellUnit();
  }

  get name() {
    return this.select.value;
  }

  /** Returns the range as the command line takes it: "stiffness=1e8:1e11:log". */
  get text() {
    return `${this.name}=${this.low.value.trim()}:${this.high.value.trim()}${this.log.checked ? ":log" : ""}`;
  }

  get bounds() {
    const [minimum, maximum] = [this.low, this.high].map(({ value }) => typed(value));
    return { minimum, maximum, ...(this.log.checked ? { spacing: "log" } : {}) };
  }

  tellUnit() {
    const { unit, help, minimum, maximum } = this.declared[this.name];
    const ends = [minimum, maximum].map((one) => (one === null || one === undefined ? "" : short(one)));
    const allowed = ends.some(Boolean) ? ` Allowed: ${ends.join(" … ")} ${unit === "1" ? "" : unitText(unit)}` : "";
    this.unit.textContent = `${help}${allowed}`;
  }

  /** Proposes a range about the default. */
  suggest() {
    const { default: middle, minimum, maximum } = this.declared[this.name];
    const [low, high] = middle > 0 ? [middle / 10, middle * 10] : [minimum, maximum];
    const kept = (value) => Math.min(Math.max(value, minimum ?? -Infinity), maximum ?? Infinity);
    const written = (value) => {
      if (value === null || value === undefined) return "";
      const number = Number(kept(value).toPrecision(3));
      return number >= 1e6 ? number.toExponential().replace("+", "") : String(number);
    };
    [this.low.value, this.high.value] = [written(low), written(high)];
    this.log.checked = typed(this.low.value) > 0 && typed(this.high.value) >= 10 * typed(this.low.value);
    this.tellUnit();
  }

  /** Returns what is wrong, or nothing. */
  trouble() {
    const { minimum, maximum } = this.bounds;
    if (Number.isNaN(minimum) || Number.isNaN(maximum)) return "Give two numbers; 0.0005 and 5e-4 are.";
    if (!(minimum < maximum)) return "The second number is to be larger.";
    if (this.log.checked && !(minimum > 0)) return "Equal ratios need numbers above zero.";
    return "";
  }

  complain(sentence) {
    this.wrong.textContent = sentence;
    for (const one of [this.low, this.high]) one.setAttribute("aria-invalid", String(sentence !== ""));
  }
}

/** Returns the range that a text gives: "stiffness=1e8:1e11:log". */
export function rangeIn(text) {
  const [name, bounds = ""] = text.split("=");
  const [minimum, maximum, log] = bounds.split(":");
  return { name, minimum, maximum, log };
}

/** A sensitivity: what an output owes to each parameter, its quantiles, and how probable a limit is. */

import { element, fill } from "../../interface/element.js";
import { freshFigure } from "../../interface/fresh_figure.js";
import { NO_NUMBER, short, typed, unitText, withUnit } from "../../interface/numbers.js";
import { note } from "../../interface/route.js";
import { table } from "../../interface/table.js";
import { whenThere } from "../../interface/when_there.js";
import { Newest } from "../../requests/newest.js";
import { get } from "../../requests/service.js";

export async function show(room, context) {
  const view = new Sensitivity(context);
  await whenThere(room, context, context.job.links.sensitivity, () => view.query(), async (answer) => {
    if (!view.element.isConnected) fill(room, view.element);
    if (view.changed) await view.questions.want();
    else await view.take(answer);
  });
}

class Sensitivity {
  constructor({ job, query, signal }) {
    Object.assign(this, { job, signal, wanted: query.get("output") });
    this.questions = new Newest(() => this.ask());
    const asked = () => {
      this.changed = true;
      this.questions.want();
    };
    this.output = element("select", { id: "output", onchange: () => {
      this.wanted = this.output.value;
      this.limit.value = ""; // it was one of another output
      asked();
    } });
    this.limit = element("input", {
      id: "limit", inputmode: "decimal", value: query.get("limit") ?? "", placeholder: "none",
      "aria-describedby": "limit-help limit-wrong", onchange: asked,
    });
    this.wrong = element("p", { class: "wrong", id: "limit-wrong" });
    this.unit = element("span", { class: "unit" });
    this.found = element("div", { class: "stacked", role: "status" });
    this.drawn = element("section", { class: "panel" });
    this.element = element("div", { class: "split" },
      element("section", { class: "panel stacked" },
        element("div", { class: "fields" },
          element("div", { class: "field" }, element("label", { for: "output" }, "Output"), this.output),
          element("div", { class: "field" }, element("label", { for: "limit" }, "Limit"),
            element("div", { class: "entry" }, this.limit, this.unit),
            element("p", { class: "help", id: "limit-help" }, "How probable is the output above it?"), this.wrong)),
        this.found),
      this.drawn);
  }

  query() {
    const limit = typed(this.limit.value);
    return {
      ...(this.wanted ? { output: this.wanted } : {}), ...(Number.isNaN(limit) ? {} : { limit }),
    };
  }

  async ask() {
    const query = this.query();
    const isWrong = query.limit === undefined && this.limit.value.trim() !== "";
    this.wrong.textContent = isWrong ? NO_NUMBER : "";
    this.limit.setAttribute("aria-invalid", String(isWrong));
    note({ output: this.wanted, limit: query.limit ?? null });
    const answer = await get(this.job.links.sensitivity, query, this.signal);
    this.take(answer).catch(() => {}); // the next question does not wait for the picture
  }

  async take(answer) {
    this.latest = answer;
    fill(this.output, answer.outputs.map((name) =>
      element("option", { value: name, selected: name === answer.output }, name)));
    this.unit.textContent = answer.unit === "1" ? "" : unitText(answer.unit);
    fill(this.found, words(answer).map((sentence) => element("p", {}, sentence)),
      measures(answer), quantiles(answer));
    const picture = Object.keys(answer.measures).length > 0
      && await freshFigure(`${this.job.links.figures}/${encodeURIComponent(answer.output)}.svg`,
        `What ${answer.output} owes to each parameter`);
    if (answer === this.latest) fill(this.drawn, picture);
  }
}

function words(found) {
  const { rows, design, note: why, mean, standard_deviation: deviation, unit, failure } = found;
  const points = `${rows.failed_points} ${rows.failed_points === 1 ? "point" : "points"}`;
  return [
    `${rows.used} rows of the design ${design}${rows.waiting ? `, ${rows.waiting} are waiting` : ""}`
      + `${rows.left_out ? `, ${rows.left_out} are left out: ${points} failed` : ""}.`
      + ` In brackets: intervals of ${short(100 * found.confidence)} %.`,
    why,
    mean !== null && `Mean ${withUnit(mean, unit)}, standard deviation ${withUnit(deviation, unit, 3)}.`,
    failure && `Above ${withUnit(failure.limit, unit)} with a probability of`
      + ` ${short(failure.probability, 3)} (${short(failure.low, 3)} … ${short(failure.high, 3)}).`,
  ].filter(Boolean);
}

function measures({ measures: found, parameters }) {
  const all = Object.entries(found);
  return all.length > 0 && table("Parameters",
    ["Parameter", ...all.map(([name]) => name.replaceAll("_", " "))],
    parameters.map((name, i) => [name, ...all.map(([, one]) => within(one, i, one.unit))]),
    "small");
}

function quantiles({ quantiles: found, unit, output }) {
  return found && table("Quantiles", ["Quantile", output], found.shares.map((share, i) =>
    [`${short(100 * share)} %`, within(found, i, unit)]), "small");
}

/** Returns a value and its interval, with digits that tell the ends apart. */
export function within({ values, low, high }, i, unit) {
  const needed = Math.ceil(Math.log10(Math.abs(values[i]) / (high[i] - low[i]))) + 2;
  const digits = Number.isFinite(needed) ? Math.max(4, needed) : 4;
  const [value, ...ends] = [values[i], low[i], high[i]].map((one) => withUnit(one, unit, digits));
  return `${value} (${ends.join(" … ")})`;
}

/** A bifurcation diagram: density, verdicts, exponents; a click leads to that simulation. */

import { element, fill } from "../../interface/element.js";
import { typed, unitText, withError } from "../../interface/numbers.js";
import { note } from "../../interface/route.js";
import { offer } from "../../interface/point_of_study.js";
import { prepared } from "../../mechanism/canvas.js";
import { onNewColours, palette } from "../../mechanism/palette.js";
import { drawAxes, extent, letters, scales } from "../../plots/axes.js";
import { drawCloud } from "../../plots/cloud.js";
import { telling } from "../../plots/telling.js";
import { VERDICTS, drawExponents, drawVerdicts } from "../../plots/verdicts.js";
import { intoATurn } from "../../plots/turns.js";
import { whenThere } from "../../interface/when_there.js";
import { withNext } from "../../requests/pages.js";
import { get } from "../../requests/service.js";

// px of a page whose letters have the usual size
const LEFT = 84;
const BELOW = 44;
const EXPONENTS = 84; // height of the exponents
const BAND = 16;
const LOOKED_AT = 8; // sections of each value, to find an observable that changes

export async function show(room, context) {
  const diagram = new Diagram(context);
  await whenThere(room, context, context.job.links.bifurcation, () => diagram.query(), async (answer) => {
    if (!diagram.element.isConnected) fill(room, diagram.element);
    await diagram.take(answer);
  });
}

class Diagram {
  constructor({ job, query, signal }) {
    Object.assign(this, { job, signal, observable: query.get("observable") });
    this.settled = Boolean(this.observable); // which observable is shown
    this.canvas = element("canvas", { class: "canvas-plot", role: "img", onclick: (e) => this.click(e) });
    this.chosen = element("div", { role: "status" });
    this.trouble = element("div", { "aria-live": "polite" });
    this.legend = element("ul", { class: "legend" });
    const observables = job.job.observables ?? [];
    this.select = element("select", { id: "observable", onchange: () => {
      this.observable = this.select.value;
      this.settled = true;
      note({ observable: this.observable });
      this.again();
    } }, observables.map((name) =>
      element("option", { value: name, selected: name === this.observable }, name)));
    this.at = element("input", {
      id: "value", inputmode: "decimal", onchange: () => this.pick(typed(this.at.value)),
    });
    this.unitOfAt = element("span", { class: "unit" });
    this.element = element("section", { class: "panel" },
      element("div", { class: "filters" },
        element("div", { class: "field" }, element("label", { for: "observable" }, "Observable"), this.select),
        element("div", { class: "field" },
          element("label", { for: "value" }, job.job.parameter),
          element("div", { class: "entry" }, this.at, this.unitOfAt)),
        element("p", { class: "quiet small" }, "Click the diagram, or give a value, to run that simulation.")),
      this.trouble, this.canvas, this.legend, this.chosen);
    onNewColours(() => this.draw(), signal);
    addEventListener("resize", () => this.draw(), { signal });
  }

  query() {
    return { observable: this.observable };
  }

  /** Asks for the observable that is chosen; says why it does not come, since another is drawn. */
  async again() {
    const { observable } = this;
    try {
      await this.take(await get(this.job.links.bifurcation, this.query(), this.signal));
    } catch (error) {
      if (error.name === "AbortError" || observable !== this.observable) return;
      const shown = this.answer ? `This is still ${this.answer.observable}. ` : "";
      fill(this.trouble, element("p", { class: "notice bad" }, `${shown}${error.message}`));
    }
  }

  /** Takes an answer and those that follow it, unless another observable has been chosen meanwhile. */
  async take(answer) {
    const wanted = () => (this.observable ?? answer.observable) === answer.observable;
    const ask = (start) => get(this.job.links.bifurcation, { start, observable: answer.observable }, this.signal);
    const pages = await withNext(answer, ask, wanted);
    if (!pages) return;
    if (!this.settled && (await this.findTelling(pages))) return;
    fill(this.trouble);
    const { parameter } = answer;
    this.parameter = parameter;
    this.unit = answer.values[parameter].unit;
    this.unitOfAt.textContent = this.unit === "1" ? "" : unitText(this.unit);
    this.answer = answer;
    this.points = pages.flatMap((page) => page.status.map((status, i) => ({
      value: page.values[parameter].values[i],
      status,
      sections: page.sections.values[i],
      backward: page.directions?.[i] === "backward",
      verdict: page.verdicts?.[i],
      reason: page.reasons?.[i],
      exponent: page.indicators.lyapunov?.values[i] ?? null,
      error: page.indicators.lyapunov_error?.values[i] ?? 0,
    })));
    if (answer.sections.unit === "rad") {
      const shown = intoATurn(this.points.flatMap(({ sections }) => sections));
      for (const one of this.points) one.sections = one.sections.map(shown);
    }
    const done = this.points.filter(({ status }) => status === "done").length;
    this.canvas.setAttribute("aria-label", `${answer.observable} at the sections over ${parameter}: `
      + `${done} of ${this.points.length} values are computed`);
    this.canvas.dataset.done = String(done);
    this.draw();
  }

  /** Shows the first observable that changes instead of the first of all, once two values are computed. */
  async findTelling(pages) {
    if (pages.flatMap(({ status }) => status).filter((one) => one === "done").length < 2) return false;
    const some = { section_stop: Math.min(LOOKED_AT, this.job.job.record) };
    const { channels } = await get(this.job.links.poincare, some, this.signal);
    const { time, ...observed } = channels;
    const found = telling(observed);
    if (this.settled || found === null) return false; // one was chosen meanwhile; or all are at rest
    this.settled = true;
    if (found === pages[0].observable) return false;
    this.select.value = this.observable = found;
    await this.again();
    return true;
  }

  draw() {
    if (!this.points || !this.canvas.clientWidth) return;
    const { canvas, points } = this;
    const colours = palette();
    const context = prepared(canvas);
    const judged = points.some(({ verdict }) => verdict);
    const size = letters();
    const below = size * (BELOW + (judged ? EXPONENTS + BAND : 0)) + (judged ? 22 : 0);
    const room = [size * LEFT, 10, canvas.clientWidth - size * LEFT - 14, canvas.clientHeight - below - 10];
    const across = extent([points.map(({ value }) => value)], 0.01);
    const layers = [false, true].map((backward) => {
      const some = points.filter((one) => one.backward === backward);
      return {
        x: some.flatMap(({ value, sections }) => sections.map(() => value)),
        y: some.flatMap(({ sections }) => sections),
        colour: colours[backward ? "backward" : "curve-0"],
      };
    }).filter(({ x }) => x.length);
    this.to = scales(room, across, extent(layers.map(({ y }) => y)));
    drawCloud(context, this.to, layers);
    const { sections, observable } = this.answer;
    const xLabel = `${this.parameter} [${this.unit}]`;
    drawAxes(context, this.to,
      { xLabel, yLabel: `${observable} [${sections.unit}]`, numbersX: !judged }, colours);
    if (judged) {
      const band = [room[0], room[1] + room[3] + 8, room[2], size * BAND];
      drawVerdicts(context, scales(band, across, [0, 1]), points, colours);
      const lower = [room[0], band[1] + band[3] + 8, room[2], size * EXPONENTS];
      const values = points.filter(({ exponent }) => exponent !== null)
        .flatMap(({ exponent, error }) => [exponent - error, exponent + error]);
      const to = scales(lower, across, extent([values, [0]], 0.1));
      drawExponents(context, to, points, colours);
      drawAxes(context, to, { xLabel, yLabel: "exponent [1/s]" }, colours);
    }
    this.explain(judged, layers.length > 1);
  }

  explain(judged, both) {
    const entry = (look, text) => element("li", {}, element("span", { class: `swatch ${look}` }), text);
    fill(this.legend,
      both && [entry("swatch-0", "forward"), entry("swatch-backward", "backward")],
      judged && element("li", { class: "quiet" }, both ? "Band, forward above:" : "Band:"),
      judged && VERDICTS.map((name) => entry(`verdict-${name}`, name)),
      judged && element("li", { class: "quiet" }, "Bars: standard errors of the exponents."));
  }

  click(event) {
    const { left } = this.canvas.getBoundingClientRect();
    if (this.to) this.pick(this.to.valueX(event.clientX - left));
  }

  /** Shows the value of the parameter that is nearest, and offers its simulation. */
  pick(value) {
    if (!this.points?.length) return;
    if (Number.isNaN(value)) {
      const said = `“${this.at.value}” is no number; 0.0005 and 5e-4 are.`;
      return void fill(this.chosen, this.at.value.trim() && element("p", { class: "notice bad" }, said));
    }
    const nearest = this.points.reduce((best, one) =>
      Math.abs(one.value - value) < Math.abs(best.value - value) ? one : best);
    this.at.value = String(nearest.value);
    const lines = [`${nearest.sections.length} sections`, nearest.verdict, nearest.reason].filter(Boolean);
    const exponent = nearest.exponent === null ? "" : `exponent ${withError(nearest.exponent, nearest.error)} 1/s`;
    const values = { [this.parameter]: [nearest.value, this.unit] };
    offer(this.chosen, this.job, values, lines.join("; "), exponent);
  }
}

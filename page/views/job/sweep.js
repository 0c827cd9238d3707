/** A sweep: extremes and statistics over one parameter as curves, over two as a map, over more as maps. */

import { button } from "../../interface/button.js";
import { element, fill } from "../../interface/element.js";
import { short, withUnit } from "../../interface/numbers.js";
import { note } from "../../interface/route.js";
import { offer } from "../../interface/point_of_study.js";
import { Quantities } from "../../interface/quantities.js";
import { tableOf } from "../../interface/table.js";
import { whenThere } from "../../interface/when_there.js";
import { prepared } from "../../mechanism/canvas.js";
import { onNewColours, palette } from "../../mechanism/palette.js";
import { drawAxes, extent, letters, scales } from "../../plots/axes.js";
import { drawCurves } from "../../plots/curves.js";
import { cellsAbout, drawMap } from "../../plots/heat_map.js";
import { withNext } from "../../requests/pages.js";
import { get } from "../../requests/service.js";

// px of a page whose letters have the usual size
const LEFT = 90;
const SCALE = 100; // of the colours, beside a map
const MOST_ROWS = 500; // of the table

export async function show(room, context) {
  const sweep = new Sweep(context);
  await whenThere(room, context, context.job.links.sweep, {}, async (answer) => {
    if (!sweep.element.isConnected) fill(room, sweep.element);
    await sweep.take(answer);
  });
}

class Sweep {
  constructor({ job, query, signal }) {
    Object.assign(this, { job, signal });
    this.quantities = new Quantities(query, (chosen) => {
      note(chosen);
      this.draw();
    });
    this.others = element("div", { class: "filters channels" });
    this.canvas = element("canvas", { class: "canvas-plot", role: "img", onclick: (event) => this.click(event) });
    this.legend = element("ul", { class: "legend" });
    this.chosen = element("div", { role: "status" });
    this.table = element("div");
    this.element = element("section", { class: "panel" }, this.quantities.element, this.others, this.canvas,
      this.legend, this.chosen,
      element("details", {}, element("summary", {}, "As a table"), this.table));
    onNewColours(() => this.draw(), signal);
    addEventListener("resize", () => this.draw(), { signal });
  }

  /** Takes an answer and those that follow it. */
  async take(answer) {
    const pages = await withNext(answer, (start) => get(this.job.links.sweep, { start }, this.signal));
    this.parameters = Object.entries(answer.values).map(([name, { unit }]) => ({
      name, unit, label: `${name} [${unit}]`,
      values: pages.flatMap((page) => page.values[name].values),
    }));
    this.quantities.take(pages, this.parameters.length === 1);
    this.layers = layersOf(this.parameters);
    if (!this.layers.some(({ words }) => words === this.layer)) this.layer = this.layers[0].words;
    this.offerLayers();
    this.draw();
  }

  /** Offers the values of the parameters that a map has no axis for. */
  offerLayers() {
    const offered = this.layers.map(({ words }) => words).join("; ");
    if (offered === this.offered || this.layers.length === 1) return; // else a list that is open would be closed
    this.offered = offered;
    const select = element("select", { id: "layer", onchange: () => {
      this.layer = select.value;
      this.draw();
    } }, this.layers.map(({ words }) => element("option", { value: words, selected: words === this.layer }, words)));
    fill(this.others, element("div", { class: "field" }, element("label", { for: "layer" }, "At"), select));
  }

  /** Returns the points that are drawn, by their index. */
  get drawn() {
    return this.layers.find(({ words }) => words === this.layer).points;
  }

  draw() {
    if (!this.parameters || !this.canvas.clientWidth) return;
    const colours = palette();
    const context = prepared(this.canvas);
    const { name, unit, curves } = this.quantities.shown(colours);
    const [first, second] = this.parameters;
    const title = `${name} [${unit}]`;
    const { clientWidth, clientHeight } = this.canvas;
    const size = letters();
    const left = LEFT * size;
    const height = clientHeight - 26 - 46 * size;
    if (this.parameters.length === 1) {
      const inside = [left, 24, clientWidth - left - 14, height];
      const all = curves.flatMap(({ values, low, high }) => (low ? [low, high] : [values]));
      this.to = scales(inside, extent([first.values]), extent(all));
      drawCurves(context, this.to, first.values, curves);
      drawAxes(context, this.to, { xLabel: first.label, yLabel: title }, colours);
    } else {
      const inside = [left, 24, clientWidth - left - SCALE * size, height];
      const [x, y, values] = [first, second, curves[0]].map((one) => this.drawn.map((i) => one.values[i]));
      this.to = scales(inside, cellsAbout(x), cellsAbout(y));
      drawMap(context, this.to, [x, y], values, colours, unit);
      drawAxes(context, this.to, { xLabel: first.label, yLabel: second.label }, colours);
    }
    this.canvas.setAttribute("aria-label",
      `${title} over ${this.parameters.slice(0, 2).map((one) => one.name).join(" and ")}${
        this.layer && `, at ${this.layer}`}`);
    fill(this.legend, curves.length > 1 && curves.map(({ title: words, swatch }) =>
      element("li", {}, element("span", { class: `swatch ${swatch}` }), words)));
    this.list(curves.filter(({ values }) => values), unit);
  }

  /** Chooses the point that is drawn nearest to a click. */
  click({ clientX, clientY }) {
    if (!this.to) return;
    const { left, top } = this.canvas.getBoundingClientRect();
    const [first, second] = this.parameters;
    const away = (i) => Math.hypot(this.to.x(first.values[i]) - clientX + left,
      second ? this.to.y(second.values[i]) - clientY + top : 0);
    this.pick(this.drawn.reduce((best, i) => (away(i) < away(best) ? i : best)));
  }

  pick(point) {
    const values = Object.fromEntries(this.parameters.map(({ name, unit, values: all }) =>
      [name, [all[point], unit]]));
    const { name, unit, curves } = this.quantities.shown(palette());
    const words = curves.filter((one) => one.values).map(({ title, values: all }) =>
      `${title} ${withUnit(all[point], unit)}`).join(", ");
    offer(this.chosen, this.job, values, `${name}: ${words}`, "");
  }

  list(curves, unit) {
    const count = this.parameters[0].values.length;
    const rows = Array.from({ length: Math.min(count, MOST_ROWS) }, (_, i) => element("tr", {},
      this.parameters.map(({ values, unit: of }) => element("td", {}, withUnit(values[i], of))),
      curves.map(({ values }) => element("td", {}, withUnit(values[i], unit, 6))),
      element("td", {}, button("Choose", () => this.pick(i), { "aria-label": `Choose point ${i + 1}` }))));
    const titles = [...this.parameters.map(({ name }) => name), ...curves.map(({ title }) => title)];
    fill(this.table, tableOf("Points", [...titles, element("td")], rows, "small"),
    count > MOST_ROWS && element("p", { class: "quiet small" }, `The first ${short(MOST_ROWS)} points.`));
  }
}

/** Returns `{words, points}` of the values that the third parameter and further ones have together. */
function layersOf(parameters) {
  const layers = new Map();
  const others = parameters.slice(2);
  parameters[0].values.forEach((_, i) => {
    const key = JSON.stringify(others.map(({ values }) => values[i]));
    const words = others.map(({ name, unit, values }) => `${name} = ${withUnit(values[i], unit, 6)}`).join(", ");
    if (!layers.has(key)) layers.set(key, { words, points: [] });
    layers.get(key).points.push(i);
  });
  return [...layers.values()];
}

/** A sweep: extremes over one parameter as curves, over two as a map. */

import { element, fill } from "../../interface/element.js";
import { withUnit } from "../../interface/numbers.js";
import { note } from "../../interface/place.js";
import { whenThere } from "../../interface/when_there.js";
import { prepared } from "../../mechanism/canvas.js";
import { onNewColours, palette } from "../../mechanism/palette.js";
import { drawAxes, extent, scales } from "../../plots/axes.js";
import { drawCloud } from "../../plots/cloud.js";
import { cellsAbout, drawMap } from "../../plots/heat_map.js";
import { get } from "../../requests/service.js";

const LEFT = 78;
const QUANTITIES = ["maximum", "minimum", "range"];

export async function show(room, context) {
  const sweep = new SweepMap(context);
  await whenThere(room, context, context.job.links.sweep, {}, async (answer) => {
    if (!sweep.element.isConnected) fill(room, sweep.element);
    await sweep.take(answer);
  });
}

class SweepMap {
  constructor({ job, query, signal }) {
    Object.assign(this, { job, signal, channel: query.get("channel"), quantity: query.get("of") ?? "maximum" });
    this.canvas = element("canvas", { class: "canvas-plot", role: "img" });
    this.choices = element("div", { class: "filters" });
    this.table = element("div");
    this.element = element("section", { class: "panel" }, this.choices, this.canvas,
      element("details", {}, element("summary", {}, "As a table"), this.table));
    onNewColours(() => this.draw(), signal);
    addEventListener("resize", () => this.draw(), { signal });
  }

  async take(answer) {
    const pages = [answer];
    while (pages.at(-1).next_start !== null) {
      const query = { start: pages.at(-1).next_start };
      pages.push(await get(this.job.links.sweep, query, this.signal));
    }
    this.pages = pages;
    this.parameters = Object.keys(answer.values);
    const channels = Object.keys(answer.peaks);
    if (!channels.includes(this.channel)) [this.channel] = channels;
    const select = (name, title, values, chosen) => {
      const made = element("select", { id: `map-${name}`, onchange: () => {
        this[name] = made.value;
        note({ channel: this.channel, of: this.quantity });
        this.draw();
      } }, values.map((value) => element("option", { value, selected: value === chosen }, value)));
      return element("div", { class: "field" }, element("label", { for: `map-${name}` }, title), made);
    };
    fill(this.choices, select("channel", "Channel", channels, this.channel),
      select("quantity", "Extreme", QUANTITIES, this.quantity));
    this.draw();
  }

  column(choose) {
    return this.pages.flatMap((page) => choose(page).map((value) => value ?? NaN));
  }

  draw() {
    if (!this.pages || !this.canvas.clientWidth) return;
    const colours = palette();
    const context = prepared(this.canvas);
    const described = this.pages[0].peaks[this.channel];
    const values = this.column((page) => page.peaks[this.channel][this.quantity]);
    const axes = this.parameters.map((name) => this.column((page) => page.values[name].values));
    const units = this.parameters.map((name) => this.pages[0].values[name].unit);
    const labels = this.parameters.map((name, i) => `${name} [${units[i]}]`);
    const title = `${this.quantity} of ${this.channel} [${described.unit}]`;
    const { clientWidth, clientHeight } = this.canvas;
    const room = [LEFT, 24, clientWidth - LEFT - 100, clientHeight - 72];
    if (this.parameters.length === 1) {
      const to = scales([...room.slice(0, 2), clientWidth - LEFT - 14, room[3]], extent([axes[0]]), extent([values]));
      drawCloud(context, to, [{ x: axes[0], y: values, colour: colours["curve-0"] }]);
      drawAxes(context, to, { xLabel: labels[0], yLabel: title }, colours);
    } else {
      const to = scales(room, cellsAbout(axes[0]), cellsAbout(axes[1]));
      drawMap(context, to, axes, values, colours, described.unit);
      drawAxes(context, to, { xLabel: labels[0], yLabel: labels[1] }, colours);
    }
    this.canvas.setAttribute("aria-label", `${title} over ${this.parameters.join(" and ")}`);
    this.list(axes, values, units, described.unit);
  }

  list(axes, values, units, unit) {
    fill(this.table, element("table", { class: "small" },
      element("thead", {}, element("tr", {}, [...this.parameters, this.quantity].map((name) =>
        element("th", { scope: "col" }, name)))),
      element("tbody", {}, values.slice(0, 500).map((value, i) => element("tr", {},
        axes.map((axis, k) => element("td", {}, withUnit(axis[i], units[k]))),
        element("td", {}, withUnit(value, unit)))))));
  }
}

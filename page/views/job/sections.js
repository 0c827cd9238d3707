/** Poincaré sections: two channels once in every period, of a run or of all points of a study. */

import { element, fill } from "../../interface/element.js";
import { note } from "../../interface/place.js";
import { whenThere } from "../../interface/when_there.js";
import { prepared } from "../../mechanism/canvas.js";
import { onNewColours, palette } from "../../mechanism/palette.js";
import { drawAxes, extent, scales } from "../../plots/axes.js";
import { drawCloud } from "../../plots/cloud.js";
import { get } from "../../requests/service.js";

export async function show(room, context) {
  const sections = new Sections(context);
  await whenThere(room, context, context.job.links.poincare, sections.query(), (answer) => {
    if (!sections.element.isConnected) fill(room, sections.element);
    sections.take(answer);
  });
}

class Sections {
  constructor({ job, query, signal }) {
    Object.assign(this, { job, signal });
    this.names = job.job.observables ?? job.job.channels;
    const outputs = this.names.filter((name) => !name.includes("."));
    const likely = outputs.length > 1 ? outputs : this.names;
    this.x = this.known(query.get("x")) ?? likely[0];
    this.y = this.known(query.get("y")) ?? likely[1] ?? likely[0];
    this.canvas = element("canvas", { class: "canvas-plot", role: "img" });
    this.note = element("p", { class: "quiet" });
    const select = (axis, title) => {
      const made = element("select", { id: `axis-${axis}`, onchange: () => this.choose(axis, made.value) },
        this.names.map((name) => element("option", { value: name, selected: name === this[axis] }, name)));
      return element("div", { class: "field" }, element("label", { for: `axis-${axis}` }, title), made);
    };
    this.element = element("section", { class: "panel" },
      element("div", { class: "filters" }, select("x", "Across"), select("y", "Up")), this.canvas, this.note);
    onNewColours(() => this.draw(), signal);
    addEventListener("resize", () => this.draw(), { signal });
  }

  known(name) {
    return this.names.includes(name) ? name : null;
  }

  query() {
    return { channels: [...new Set([this.x, this.y])].join(",") };
  }

  async choose(axis, name) {
    this[axis] = name;
    note({ x: this.x, y: this.y });
    this.take(await get(this.job.links.poincare, this.query(), this.signal));
  }

  take(answer) {
    this.answer = answer;
    this.draw();
  }

  draw() {
    if (!this.answer || !this.canvas.clientWidth) return;
    const [x, y] = [this.x, this.y].map((name) =>
      this.answer.channels[name].values.flat().map((value) => value ?? NaN));
    const colours = palette();
    const context = prepared(this.canvas);
    const { clientWidth, clientHeight } = this.canvas;
    const to = scales([78, 10, clientWidth - 92, clientHeight - 56], extent([x]), extent([y]));
    drawCloud(context, to, [{ x, y, colour: colours["curve-0"] }]);
    const label = (name) => `${name} [${this.answer.channels[name].unit}]`;
    drawAxes(context, to, { xLabel: label(this.x), yLabel: label(this.y) }, colours);
    this.canvas.setAttribute("aria-label", `${x.length} sections: ${this.y} over ${this.x}`);
    this.note.textContent = this.answer.note || `${x.length} sections.`;
  }
}

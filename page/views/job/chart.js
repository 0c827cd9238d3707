/** A chart: the motion, or a quantity, over two parameters, while it is computed and after. */

import { mapOfAttractors } from "../../charts/attractors.js";
import { ChartMap } from "../../charts/map.js";
import { Tiles } from "../../charts/tiles.js";
import { element, fill } from "../../interface/element.js";
import { short, unitText, withUnit } from "../../interface/numbers.js";
import { note } from "../../interface/route.js";
import { offer, sceneWith } from "../../interface/point_of_study.js";
import { whenThere } from "../../interface/when_there.js";
import { Newest } from "../../requests/newest.js";
import { get } from "../../requests/service.js";

export async function show(room, context) {
  const chart = new Chart(context);
  await whenThere(room, context, context.job.links.chart, {}, async (answer) => {
    if (!answer.quantities.length) { // points are being computed, and none has ended
      fill(room, element("p", { class: "panel" }, "The first points are shown here as soon as they are computed."));
      return;
    }
    if (!chart.element.isConnected) fill(room, chart.element);
    chart.take(answer);
  });
}

const ORBITS = 200; // of a branch that a point offers, in each direction

class Chart {
  constructor({ job, query, signal }) {
    Object.assign(this, { job, signal, wanted: query.get("quantity") });
    this.points = new Newest((point) => this.pick(point));
    this.shares = new Newest(() => this.showAttractors());
    this.filters = element("div", { class: "filters channels" });
    this.place = element("div");
    this.legend = element("ul", { class: "legend" });
    this.under = element("p", { class: "quiet small" });
    this.inherited = element("p", { class: "quiet small" });
    this.attractors = element("div");
    this.chosen = element("div", { role: "status" });
    this.element = element("section", { class: "panel" },
      this.filters, this.place, this.legend, this.inherited, this.under, this.chosen, this.attractors);
  }

  /** Takes what the chart holds by now. */
  take(answer) {
    const grown = this.answer?.ended !== answer.ended;
    this.answer = answer;
    if (!this.map) {
      this.map = new ChartMap(answer, this.signal, (point) => this.points.want(point), (point) => this.hover(point));
      fill(this.place, this.map.canvas);
    }
    const { quantities, ended, points, inherited } = answer;
    if (!quantities.some(({ name }) => name === this.wanted)) this.wanted = quantities[0].name;
    this.offerQuantities();
    this.tell();
    this.under.textContent = ended < points
      ? `${short(ended, 7)} of ${short(points, 7)} points are computed; others show the nearest that is.`
      : `${short(points, 7)} points. Drag to move, scroll to scale, double click for all of it.`;
    this.inherited.textContent = inherited > 0
      ? `${short(inherited, 7)} points were not computed: the corners of their cell are alike, and they have the results of one of them.`
      : "";
    if (!grown) return;
    this.behind = Boolean(this.tiles?.waiting()); // else a map that grows fast would never be whole
    if (!this.behind) this.showTiles(this.tiles);
    this.shares.want();
  }

  async showAttractors() {
    const { attractors } = this.job.links;
    if (attractors) fill(this.attractors, mapOfAttractors(await get(attractors, {}, this.signal)));
  }

  get quantity() {
    return this.answer.quantities.find(({ name }) => name === this.wanted);
  }

  offerQuantities() {
    const offered = this.answer.quantities.map(({ name }) => name).join();
    if (offered === this.offered) return; // else a list that is open would be closed
    this.offered = offered;
    const made = element("select", { id: "chart-quantity", onchange: () => {
      this.wanted = made.value;
      note({ quantity: this.wanted });
      this.tell();
      this.showTiles();
    } }, this.answer.quantities.map(({ name, long_name: words }) =>
      element("option", { value: name, selected: name === this.wanted }, words)));
    fill(this.filters, element("div", { class: "field" }, element("label", { for: made.id }, "Shown"), made));
  }

  /** Asks for the tiles of what there is by now; until they come, those `before` are shown. */
  showTiles(before = null) {
    const { name, low, high } = this.quantity;
    const query = { ended: this.answer.ended, ...(low === null ? {} : { low, high }) };
    const path = `${this.job.links.self}/tiles/${encodeURIComponent(name)}`;
    this.tiles = new Tiles(path, query, this.signal, () => this.arrived(), before);
    this.map.show(this.tiles);
  }

  arrived() {
    this.map.draw();
    if (!this.behind || this.tiles.waiting()) return;
    this.behind = false;
    this.showTiles(this.tiles);
  }

  /** Says what the colours mean. */
  tell() {
    const { labels, unit, low, high, shades } = this.quantity;
    const mark = (colour) => {
      const made = element("span", { class: "swatch" });
      made.style.background = colour;
      return made;
    };
    if (labels) {
      fill(this.legend, labels.map(({ name, colour, points }) =>
        element("li", {}, mark(colour), `${name} (${short(points, 7)})`)));
      return;
    }
    fill(this.legend, low === null ? element("li", {}, "No value is known yet.") : [
      element("li", {}, withUnit(low, unit, 3)),
      ...shades.map((colour) => element("li", {}, mark(colour))),
      element("li", {}, `${withUnit(high, unit, 3)} ${unit === "1" ? "" : `(${unitText(unit)})`}`),
    ]);
  }

  values([column, row]) {
    const { x, y } = this.answer;
    return { [x.parameter]: [x.values[column], x.unit], [y.parameter]: [y.values[row], y.unit] };
  }

  hover(point) {
    this.map.canvas.title = point === null ? "" : Object.entries(this.values(point)).map(
      ([name, [value, unit]]) => `${name} = ${withUnit(value, unit, 5)}`).join(", ");
  }

  /** Returns the diagrams along both lines through a point, as jobs of its values. */
  cuts() {
    const { along, by, scene, settle, record, section, tolerance, method, continuation } = this.job.job;
    if (along.start || by.start) return {}; // a diagram begins as its scene says
    const shared = { kind: "bifurcation", settle, record, section, tolerance, method };
    const chained = continuation && continuation !== "none" ? { continuation, chains: 1 } : {};
    return Object.fromEntries([along, by].map(({ parameter, values }) => [`Diagram over ${parameter}`,
      ({ [parameter]: _, ...held }) => ({
        ...shared, scene: sceneWith(scene, held), parameter, values,
        ...(parameter === along.parameter ? chained : {}),
      })]));
  }

  /** Returns the branches of periodic orbits through a point, over either parameter, as jobs of its values. */
  branches(period) {
    const { along, by, scene, settle } = this.job.job;
    if (along.start || by.start || !(period > 0)) return {};
    const { x, y } = this.answer;
    return Object.fromEntries([[along, x], [by, y]].map(([{ parameter }, { values }]) => [`Branch over ${parameter}`,
      ({ [parameter]: at, ...held }) => ({
        kind: "continuation", scene: sceneWith(scene, held), parameter, period, at,
        values: { from: values.at(0), to: values.at(-1), count: ORBITS },
        ...(typeof settle === "number" ? { settle } : {}),
      })]));
  }

  /** Returns the numbers of the start at a point, by their pointers into the scene. */
  starts([column, row]) {
    const { along, by } = this.job.job;
    const { x, y } = this.answer;
    return Object.fromEntries([[along, x.values[column]], [by, y.values[row]]]
      .filter(([{ start }]) => start).map(([{ start }, value]) => [start, value]));
  }

  async pick(point) {
    const [column, row] = point;
    let found;
    try {
      found = await get(`${this.job.links.chart}/point`, { column, row }, this.signal);
    } catch (error) {
      if (error.name === "AbortError") throw error;
      fill(this.chosen, element("p", { class: "notice bad" }, error.message)); // what was there is of another point
      return;
    }
    const words = found.status !== "done" ? found.detail || found.status : [Object.entries(found.quantities)
      .filter(([, { value }]) => value !== null)
      .map(([, quantity]) => told(quantity)), found.detail].flat().filter(Boolean).join("; ");
    const others = { ...this.cuts(), ...this.branches(found.quantities?.period?.value) };
    offer(this.chosen, this.job, this.values(point), words, "", others, this.starts(point));
  }
}

/** Returns a quantity of a point in words, as its name says what a value of 0 means. */
function told({ long_name: named, value, unit, label }) {
  const [name, none] = named.split("; 0: ");
  return `${name}: ${(value === 0 && none) || (label ?? withUnit(value, unit, 4))}`;
}

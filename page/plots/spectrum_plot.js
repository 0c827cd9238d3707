/** A power spectrum on two logarithmic axes, as far as its curve is seen. */

import uPlot from "../vendor/uplot/uPlot.esm.min.js";
import { element, fill } from "../interface/element.js";
import { short, unitText, withUnit } from "../interface/numbers.js";
import { axisFont, letters } from "./axes.js";
import { onNewColours, palette } from "../mechanism/palette.js";

const HEIGHT = 0.6; // of the window
const DECADES = 12; // below the strongest power; what lies deeper is rounding

export class SpectrumPlot {
  constructor(signal) {
    Object.assign(this, { signal });
    this.room = element("div");
    this.value = element("p", { class: "quiet small" }, "\u00a0");
    this.element = element("div", { role: "img", "aria-label": "Power over frequency" }, this.room, this.value);
    onNewColours(() => this.draw(), signal);
    signal.addEventListener("abort", () => {
      this.plot?.destroy();
      this.plot = null;
    });
    new ResizeObserver(() => this.plot?.setSize({ width: this.room.clientWidth, height: this.height }))
      .observe(this.room);
  }

  /** @param density `{frequency, density, unit, band_limit}` as the service answers, of a channel */
  show(channel, density) {
    Object.assign(this, { channel, density });
    this.draw();
  }

  draw() {
    this.plot?.destroy();
    this.plot = null;
    fill(this.room);
    if (this.signal.aborted || !this.density?.frequency.length || !this.room.clientWidth) return;
    const { frequency, density, unit, band_limit: limit } = this.density;
    const top = density.reduce((most, one) => Math.max(most, one), 0);
    const bottom = top / 10 ** DECADES;
    const last = frequency[density.findLastIndex((one) => one >= bottom)];
    this.plot = new uPlot(this.options(unit, [bottom, 3 * top], last),
      [frequency, density.map((one) => one || null)], this.room);
    this.element.setAttribute("aria-label", `Power of ${this.channel} over frequency, up to ${
      withUnit(limit, "Hz", 3)}`);
  }

  /** Returns what a plane of points beside it has, px. */
  get height() {
    const rem = 16 * letters();
    return Math.min(Math.max(18 * rem, HEIGHT * innerHeight), 60 * rem);
  }

  options(unit, range, last) {
    const size = letters();
    const colours = palette();
    const axis = {
      font: axisFont(), labelFont: axisFont(), stroke: colours.quiet,
      grid: { stroke: colours.faint, width: 0.15 }, ticks: { width: 0.5 },
      values: (_, ticks) => ticks.map((one) => (one === null ? "" : short(one, 3))),
    };
    return {
      width: this.room.clientWidth,
      height: this.height,
      legend: { show: false },
      scales: {
        x: { time: false, distr: 3, range: [this.density.frequency[0], last] },
        y: { distr: 3, range },
      },
      cursor: { drag: { x: false, y: false } },
      series: [{}, { stroke: colours["curve-0"], width: size, points: { show: false } }],
      axes: [
        { ...axis, size: 44 * size, label: "frequency [Hz]", labelSize: 20 * size },
        { ...axis, size: 74 * size, label: unitText(unit), labelSize: 18 * size },
      ],
      hooks: { setCursor: [(plot) => this.read(plot, unit)] },
    };
  }

  read({ cursor: { idx }, data }, unit) {
    const told = idx === null || idx === undefined
      ? "\u00a0" : `${short(data[1][idx], 3)} ${unit} at ${withUnit(data[0][idx], "Hz")}`;
    this.value.textContent = told;
  }
}

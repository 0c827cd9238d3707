/** Stacked plots over one axis of time: zoom, pan, a cursor shared with a clock. */

import uPlot from "../vendor/uplot/uPlot.esm.min.js";
import { button } from "../interface/button.js";
import { element, fill } from "../interface/element.js";
import { apart, axisUnit, short, withUnit } from "../interface/numbers.js";
import { onNewColours, palette } from "../mechanism/palette.js";
import { Newest } from "../requests/newest.js";
import { mayPass, pause } from "../requests/service.js";
import { histories } from "./history_data.js";
import { axisFont, letters } from "./axes.js";
import { drawUnconverged, drawImpacts } from "./marks.js";
import { Panning } from "./panning.js";

const HEIGHT = 150; // px of a plot
const QUIET = 60; // ms without a change of the window until it stands
const COME_BACK = 2000; // ms after which what a busy service refused is asked for again

export class HistoryPlots {
  /**
   * @param jobs jobs as the service shows them, compared in the same plots
   * @param clock time that is shown beside; a click sets it
   * @param onWindow called with `[start, stop]` when the window has changed and stands; nulls: all
   */
  constructor(jobs, clock, signal, onWindow = () => {}) {
    Object.assign(this, { jobs, clock, signal, onWindow, plots: new Map(), onsets: [] });
    this.certificate = null;
    this.questions = new Newest(() => this.ask());
    this.fetching = new AbortController();
    this.standing = new AbortController();
    this.all = [clock.first, clock.last];
    this.window = [...this.all];
    this.room = element("div", {}, element("p", { class: "quiet" }, "Reading …"));
    this.note = element("p", { class: "quiet small", role: "status" });
    this.element = element("div", { class: "plot-stack" }, this.controls(), this.room, this.note);
    this.key = `history-${Math.random()}`;
    signal.addEventListener("abort", () => {
      this.fetching.abort();
      this.standing.abort();
      this.clear();
    });
    clock.listen((time) => this.follow(time));
    onNewColours(() => this.rebuild(), signal);
    new ResizeObserver(() => this.resize()).observe(this.room);
  }

  /** Shows these channels, in this order. */
  async show(channels) {
    this.channels = channels;
    this.fetching.abort();
    await this.questions.want();
  }

  /** Sets the window of time; it stays inside what there is. */
  setWindow(window) {
    this.fetching.abort(); // it is of another
    this.place(window);
  }

  place([start, stop]) {
    const width = Math.min(stop - start, this.all[1] - this.all[0]);
    const first = Math.min(Math.max(start, this.all[0]), this.all[1] - width);
    this.window = [first, first + width];
    for (const { plot } of this.plots.values()) {
      plot.setScale("x", { min: this.window[0], max: this.window[1] });
    }
    this.later();
  }

  /** Zooms by a factor about a time, by default the middle. */
  zoom(factor, about = (this.window[0] + this.window[1]) / 2) {
    const [start, stop] = this.window;
    const least = (this.jobs[0].job.output_step ?? 0) * 4;
    if ((stop - start) * factor < least && factor < 1) return;
    this.setWindow([about - (about - start) * factor, about + (stop - about) * factor]);
  }

  /** Moves the window by a share of its width. */
  move(share) {
    const width = this.window[1] - this.window[0];
    this.setWindow(this.window.map((one) => one + share * width));
  }

  /** Shows what a running job has computed meanwhile, after what is on its way. */
  extend(last) {
    const whole = this.window[1] >= this.all[1] && this.window[0] <= this.all[0];
    this.all[1] = last;
    if (whole) this.place([...this.all]);
  }

  /** Tells of the window and fetches it once it stands still: a new address costs a frame. */
  later() {
    this.standing.abort();
    this.standing = new AbortController();
    pause(QUIET, this.standing.signal).then(() => {
      if (this.signal.aborted) return; // the view was left, and the address is another's
      const whole = this.window[1] - this.window[0] >= this.all[1] - this.all[0];
      this.onWindow(whole ? [null, null] : this.window);
      this.questions.want();
    }, () => {});
  }

  async ask() {
    if (this.signal.aborted || !this.channels) return;
    this.fetching = new AbortController();
    const { signal } = this.fetching;
    const points = Math.max(200, Math.min(this.room.clientWidth || 800, 4000));
    try {
      const { channels, note } = await histories(this.jobs, this.channels, this.window, points, signal);
      if (signal.aborted) return;
      this.data = channels;
      this.note.textContent = note;
      this.draw();
    } catch (error) {
      if (error.name === "AbortError") return;
      this.clear();
      fill(this.room, element("p", { class: "notice" }, error.message));
      if (mayPass(error)) pause(COME_BACK, signal).then(() => this.questions.want(), () => {});
    }
  }

  /** Draws what is known besides the curves: `onsets` of contacts, the `certificate`. */
  mark(known) {
    Object.assign(this, known);
    if (this.data && this.channels.every((channel) => channel in this.data)) this.draw();
  }

  draw() {
    const same = this.channels.join() === [...this.plots.keys()].join();
    if (!same || !this.plots.size) this.rebuild();
    for (const channel of this.channels) {
      const { plot } = this.plots.get(channel);
      plot.setData(this.joined(channel), false);
      plot.setScale("x", { min: this.window[0], max: this.window[1] });
    }
    this.follow(this.clock.time);
  }

  joined(channel) {
    const { curves } = this.data[channel];
    return curves.length === 1 ? curves[0] : uPlot.join(curves);
  }

  /** Ends the plots: each listens to the window, and to the cursors of the others. */
  clear() {
    for (const { plot } of this.plots.values()) plot.destroy();
    this.plots.clear();
  }

  rebuild() {
    this.clear();
    fill(this.room);
    if (!this.data) return;
    this.channels.forEach((channel, i) => {
      const { unit, longName } = this.data[channel];
      const value = element("span", { class: "value" });
      const head = element("h3", {}, channel, " ",
        element("span", { class: "quiet small" }, longName), value);
      const mark = element("div", { class: "time-mark" });
      const place = element("div", { class: "plot" }, head);
      this.room.append(place);
      const last = i === this.channels.length - 1;
      const plot = new uPlot(this.options(channel, unit, value, last), this.joined(channel), place);
      plot.over.append(mark);
      new Panning(plot, this);
      this.plots.set(channel, { plot, mark, value });
    });
  }

  options(channel, unit, value, last) {
    const colours = palette();
    const size = letters();
    const suited = ({ scales: { y } }) => axisUnit(unit, Math.max(Math.abs(y.min), Math.abs(y.max)));
    const axis = {
      font: axisFont(), labelFont: axisFont(),
      stroke: colours.quiet, grid: { stroke: colours.faint, width: 0.3 }, ticks: { width: 0.5 },
    };
    return {
      width: this.room.clientWidth,
      height: size * (HEIGHT + (last ? 26 : 0)),
      legend: { show: false },
      scales: { x: { time: false }, y: { range: (_, low, high) => span(low, high) } },
      cursor: { sync: { key: this.key }, drag: { x: true, y: false, setScale: false }, points: { size: 6 } },
      series: [
        {},
        ...this.jobs.map((_, i) => ({
          stroke: colours[`curve-${i % 4}`], width: 1.2 * size, spanGaps: true, points: { show: false },
        })),
      ],
      axes: [
        { ...axis, show: true, size: size * (last ? 44 : 18), label: last ? "time [s]" : null, labelSize: 20 * size,
          values: (_, ticks) => ticks.map((one) => (last ? short(one, 6) : "")) },
        { ...axis, size: 74 * size, label: (plot) => suited(plot)[1], labelSize: 18 * size,
          values: (plot, ticks) => apart(ticks.map((one) => one / suited(plot)[0])).map(([, text]) => text) },
      ],
      hooks: {
        drawAxes: [(plot) => {
          drawUnconverged(plot, this.certificate, this.certificate?.channels[channel]?.extremes);
        }],
        draw: [(plot) => drawImpacts(plot, this.onsets)],
        setSelect: [(plot) => this.select(plot)],
        setCursor: [(plot) => this.read(plot, value, unit)],
      },
    };
  }

  select(plot) {
    const { left, width } = plot.select;
    if (width < 4) return;
    plot.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
    this.setWindow([plot.posToVal(left, "x"), plot.posToVal(left + width, "x")]);
  }

  read(plot, value, unit) {
    const { idx } = plot.cursor;
    if (idx === null || idx === undefined) {
      value.textContent = "";
      return;
    }
    const values = plot.data.slice(1).map((curve) => withUnit(curve[idx], unit));
    value.textContent = `${values.join("  ·  ")} at ${withUnit(plot.data[0][idx], "s", 6)}`;
  }

  follow(time) {
    for (const { plot, mark } of this.plots.values()) {
      const { min, max } = plot.scales.x;
      mark.hidden = !(time >= min && time <= max);
      if (!mark.hidden) mark.style.transform = `translateX(${plot.valToPos(time, "x")}px)`;
    }
  }

  resize() {
    for (const { plot } of this.plots.values()) {
      plot.setSize({ width: this.room.clientWidth, height: plot.height });
    }
  }

  controls() {
    const made = (text, title, act) =>
      button(text, act, { title, "aria-label": /\w/.test(text) ? null : title });
    return element("div", { class: "buttons" },
      made("+", "Zoom in", () => this.zoom(0.5, this.clock.time)),
      made("−", "Zoom out", () => this.zoom(2)),
      made("◂", "Earlier", () => this.move(-0.5)),
      made("▸", "Later", () => this.move(0.5)),
      made("All", "The whole run", () => this.setWindow([...this.all])),
      element("span", { class: "quiet small" },
        "Drag or scroll to zoom, shift-drag or scroll sideways to pan, click to go there."));
  }
}

/** Returns the ends of a vertical axis; zero all along is in its middle. */
function span(low, high) {
  if (low === null) return [null, null];
  return low === 0 && high === 0 ? [-1, 1] : uPlot.rangeNum(low, high, 0.1, true);
}

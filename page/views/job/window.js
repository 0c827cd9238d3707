/** The window of time that histories show, looked at otherwise: phase portrait and spectrum. */

import { element, fill } from "../../interface/element.js";
import { withUnit } from "../../interface/numbers.js";
import { note } from "../../interface/route.js";
import { instants } from "../../plots/instants.js";
import { Plane, firstPlane } from "../../plots/plane.js";
import { SpectrumPlot } from "../../plots/spectrum_plot.js";
import { get, pause } from "../../requests/service.js";

const QUIET = 300; // ms without a change of the window before anything is asked
const COUNTS = [50_000, 300_000, 1_000_000];

/** A part of the page that is filled while it is open, and again when the window has changed. */
class Look {
  /** @param name what the address calls it: `name=open` */
  constructor(name, title, query, signal, ...content) {
    Object.assign(this, { signal, asking: new AbortController() });
    this.trouble = element("p", { class: "quiet", role: "status" });
    this.element = element("details", {
      class: "panel", open: query.has(name), ontoggle: () => {
        note({ [name]: this.element.open ? "open" : null });
        this.later();
      },
    }, element("summary", {}, title), this.trouble, content);
    signal.addEventListener("abort", () => this.asking.abort());
  }

  /** @param window `[start, stop]` in s */
  follow(window) {
    this.window = [...window];
    this.later();
  }

  async later() {
    this.asking.abort();
    if (!this.element.open || !this.window || this.signal.aborted) return;
    this.asking = new AbortController();
    try {
      await pause(QUIET, this.asking.signal);
      await this.ask(this.window, this.asking.signal);
      fill(this.trouble);
    } catch (error) {
      if (error.name !== "AbortError") fill(this.trouble, error.message);
    }
  }
}

/** Two channels against one another. */
export class PhasePortrait extends Look {
  constructor(job, query, signal) {
    const names = job.job.channels;
    const plane = new Plane(names, firstPlane(names, query), signal, ([x, y]) => {
      note({ x, y });
      this.later();
    });
    const count = element("select", { id: "points", onchange: () => {
      note({ points: count.value });
      this.later();
    } }, COUNTS.map((one) => element("option", {
      value: one, selected: String(one) === query.get("points"),
    }, one.toLocaleString("en").replaceAll(",", " "))));
    plane.element.firstChild.append(element("div", { class: "field" },
      element("label", { for: "points" }, "Points"), count));
    super("phase", "Phase portrait of the window shown", query, signal, plane.element);
    Object.assign(this, { job, plane, count });
  }

  async ask(window, signal) {
    const names = [...this.plane.chosen];
    const found = await instants(this.job, names, window, Number(this.count.value), signal);
    const [x, y] = names.map((name) => found.columns[name]);
    const what = found.exact ? "instants" : "samples, the end of the window at most";
    const words = `${x.length} ${what}, ${withUnit(found.step, "s", 3)} apart`;
    this.plane.show({ x, y, names, units: names.map((name) => found.units[name]), words });
  }
}

/** Power of one channel over frequency. */
export class Spectrum extends Look {
  constructor(job, query, signal) {
    const names = job.job.channels;
    const wanted = query.get("of");
    const select = element("select", { id: "of", onchange: () => {
      note({ of: select.value });
      this.later();
    } }, names.map((name) => element("option", { value: name, selected: name === wanted }, name)));
    if (!names.includes(wanted)) select.value = names.find((name) => !name.includes(".")) ?? names[0];
    const plot = new SpectrumPlot(signal);
    const told = element("p", { class: "quiet small" });
    super("spectrum", "Spectrum of the window shown", query, signal,
      element("div", { class: "filters channels" }, element("div", { class: "field" },
        element("label", { for: "of" }, "Channel"), select)), plot.element, told);
    Object.assign(this, { job, select, plot, told });
  }

  async ask([start, stop], signal) {
    const channel = this.select.value;
    const { spectra, note: more } =
      await get(this.job.links.spectrum, { channels: channel, start, stop }, signal);
    const limit = withUnit(spectra[channel].band_limit, "Hz", 3);
    this.plot.show(channel, spectra[channel]);
    fill(this.told, `Band limit ${limit}: what is faster appears below it. ${more}`);
  }
}

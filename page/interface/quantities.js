/** Quantities of a sweep: extremes of channels, their statistics, and what else points have. */

import { element, refill } from "./element.js";

const EXTREMES = ["maximum", "minimum", "range"];
const TOGETHER = "extremes";
const WITH_MEAN = "extremes and mean";

export class Quantities {
  /** @param onchoice called with `{channel, of}` whenever one of them is chosen */
  constructor(query, onchoice) {
    Object.assign(this, { channel: query.get("channel"), of: query.get("of"), onchoice });
    this.element = element("div", { class: "filters channels" });
  }

  /** Takes the pages of an answer; `together`: the curves of a channel may be shown as one. */
  take(pages, together) {
    this.pages = pages;
    this.together = together;
    this.draw();
  }

  draw() {
    const [{ peaks, statistics }] = this.pages;
    const channels = Object.keys(peaks);
    const others = Object.keys(statistics).filter((name) =>
      !channels.some((channel) => name.startsWith(`${channel}.`)));
    const known = [...channels, ...others];
    if (!known.includes(this.channel)) { // declared outputs come first, as in figures
      this.channel = channels.find((name) => !name.includes(".")) ?? channels[0];
    }
    const of = this.choices();
    if (!of.includes(this.of)) [this.of] = of;
    refill(this.element, this.select("channel", "Of", known), of.length > 1 && this.select("of", "Quantity", of));
  }

  select(name, title, values) {
    const made = element("select", { id: `sweep-${name}`, onchange: () => {
      this[name] = made.value;
      this.draw();
      this.onchoice({ channel: this.channel, of: this.of });
    } }, values.map((value) => element("option", { value, selected: value === this[name] },
      value.replaceAll("_", " "))));
    return element("div", { class: "field" }, element("label", { for: made.id }, title), made);
  }

  /** Names of what is known of the channel that is chosen. */
  choices() {
    const [{ peaks, statistics }] = this.pages;
    if (!peaks[this.channel]) return [""];
    const start = `${this.channel}.`;
    const own = Object.keys(statistics).filter((name) => name.startsWith(start))
      .map((name) => name.slice(start.length));
    const all = own.includes("mean") ? WITH_MEAN : TOGETHER;
    return [...(this.together ? [all] : []), ...EXTREMES, ...own];
  }

  /** Returns `{name, unit, curves: [{title, values, colour, swatch}]}`; a band has low and high. */
  shown(colours) {
    const { channel, of } = this;
    const [{ peaks, statistics }] = this.pages;
    const { unit } = peaks[channel] ?? statistics[channel];
    const curve = (quantity, place = 0) => ({
      title: quantity.replaceAll("_", " ") || channel, values: this.column(quantity),
      colour: colours[`curve-${place}`], swatch: `swatch-${place}`,
    });
    if (of !== TOGETHER && of !== WITH_MEAN) return { name: of ? `${of.replaceAll("_", " ")} of ${channel}` : channel, unit, curves: [curve(of)] };
    const mean = statistics[`${channel}.mean`] && curve("mean", 2);
    const spread = mean && statistics[`${channel}.standard_deviation`] && this.column("standard_deviation");
    const band = spread && {
      ...mean, title: "mean ± standard deviation", values: undefined,
      low: mean.values.map((value, i) => value - spread[i]),
      high: mean.values.map((value, i) => value + spread[i]),
    };
    return { name: channel, unit, curves: [band, curve("maximum", 1), curve("minimum", 0), mean].filter(Boolean) };
  }

  /** A point that failed has extremes of what it had computed: they are not those of whole runs. */
  column(quantity) {
    const { channel } = this;
    const name = quantity ? `${channel}.${quantity}` : channel;
    const extreme = EXTREMES.includes(quantity);
    return this.pages.flatMap(({ peaks, statistics, status }) =>
      (extreme ? peaks[channel][quantity] : statistics[name].values)
        .map((value, i) => (extreme && status[i] === "failed" ? NaN : value ?? NaN)));
  }
}

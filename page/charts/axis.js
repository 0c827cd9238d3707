/** An axis of a chart: from the index of a point to its value, and the marks beside the map. */

import { apart, axisLabel, axisUnit, short } from "../interface/numbers.js";
import { ticks } from "../plots/axes.js";

const EVEN = 1e-6; // of a step, by which equal steps differ at most

export class Axis {
  constructor({ parameter, unit, values }) {
    Object.assign(this, { name: parameter, unit, values, count: values.length });
    const step = (values.at(-1) - values[0]) / Math.max(values.length - 1, 1);
    this.even = values.every((value, i) => Math.abs(value - values[0] - i * step) <= EVEN * Math.abs(step));
    this.step = step;
  }

  /**
   * Returns `{label, marks}`: the axis' label with a unit that suits, and `[index, text]` of marks.
   *
   * @param visible first and last index that are seen, in parts of points
   * @param wanted about how many marks
   */
  ticks([first, last], wanted) {
    const clamped = (index) => Math.min(Math.max(Math.round(index), 0), this.count - 1);
    const ends = [this.values[clamped(first)], this.values[clamped(last)]];
    const [one, written] = axisUnit(this.unit, Math.max(...ends.map(Math.abs)));
    const label = axisLabel(this.name, written);
    if (!this.even || !this.step) {
      const indices = ticks([Math.max(first, 0), Math.min(last, this.count - 1)], wanted).map(Math.round);
      return { label, marks: [...new Set(indices)].map((i) => [i, short(this.values[i] / one, 4)]) };
    }
    const values = [first, last].map((index) => (this.values[0] + index * this.step) / one);
    const marks = apart(ticks(values.sort((a, b) => a - b), wanted)).map(([value, text]) =>
      [(value * one - this.values[0]) / this.step, text]);
    return { label, marks };
  }
}

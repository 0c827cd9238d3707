/** Axes of plots on a canvas: nice numbers, labels, and the way from values to pixels. */

import { apart, axisLabel, axisUnit, short } from "../interface/numbers.js";

const ROUNDING = 1e-12; // of the larger end: a range that is narrower has no scale
const MOST_DIGITS = 6; // of a number beside an axis: there is no room for more
const LEAST = 1e-300; // of a range: below, powers of ten are rounded to nothing

/** Returns how much larger letters are than on a page of usual size: they grow on large screens. */
export function letters() {
  return parseFloat(getComputedStyle(document.documentElement).fontSize) / 16;
}

/** Returns the font of numbers and labels beside axes. */
export function axisFont() {
  return `${12 * letters()}px system-ui, sans-serif`;
}

/** Returns the way from values to pixels of a rectangle `[left, top, width, height]`. */
export function scales([left, top, width, height], [x0, x1], [y0, y1]) {
  const [dx, dy] = [x1 - x0 || 1, y1 - y0 || 1];
  return {
    room: [left, top, width, height],
    domain: [x0, x1, y0, y1],
    x: (value) => left + ((value - x0) / dx) * width,
    y: (value) => top + height - ((value - y0) / dy) * height,
    valueX: (pixel) => x0 + ((pixel - left) / width) * dx,
    valueY: (pixel) => y0 + ((top + height - pixel) / height) * dy,
  };
}

/** Returns the smallest and largest finite value, with some room beyond. */
export function extent(lists, room = 0.04) {
  let [low, high] = [Infinity, -Infinity];
  for (const list of lists) {
    for (const value of list) {
      if (!Number.isFinite(value)) continue;
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  if (low > high) return [0, 1];
  const margin = differ(low, high) ? (high - low) * room : Math.abs(high) / 2 || 1;
  return [low - margin, high + margin];
}

/** Returns whether two ends of a range differ by more than rounding. */
function differ(low, high) {
  return high - low > Math.max(ROUNDING * Math.max(Math.abs(low), Math.abs(high)), LEAST);
}

/**
 * Returns round numbers in a range, about as many as wanted; at least two, which show the scale. A
 * range that is rounding alone has its beginning.
 */
export function ticks([low, high], wanted) {
  if (!differ(low, high)) return [low];
  const raw = (high - low) / Math.max(wanted, 1);
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].find((one) => one * power >= raw) * power;
  const found = [];
  for (let k = Math.ceil(low / step); k * step <= high + 1e-9 * step; k++) found.push(k * step);
  return found.length < 2 ? ticks([low, high], 2 * Math.max(wanted, 1)) : found;
}

/** Draws a frame with ticks and labels, whose units `[m]` get prefixes that suit the values. */
export function drawAxes(context, to, { xLabel = "", yLabel = "", numbersX = true }, colours) {
  const [left, top, width, height] = to.room;
  const [x0, x1, y0, y1] = to.domain;
  const size = letters();
  const across = marked(xLabel, [x0, x1], width / (90 * size));
  const up = marked(yLabel, [y0, y1], height / (45 * size));
  context.font = axisFont();
  context.lineWidth = 1;
  context.strokeStyle = colours.faint;
  context.fillStyle = colours.quiet;
  context.strokeRect(left + 0.5, top + 0.5, width, height);
  context.textAlign = "center";
  context.textBaseline = "top";
  for (const [value, text] of across.marks) {
    const x = Math.round(to.x(value)) + 0.5;
    line(context, [x, top + height], [x, top + height + 5]);
    if (numbersX) context.fillText(text, x, top + height + 7);
  }
  if (numbersX) context.fillText(across.label, left + width / 2, top + height + 9 + 14 * size);
  context.textAlign = "right";
  context.textBaseline = "middle";
  for (const [value, text] of up.marks) {
    const y = Math.round(to.y(value)) + 0.5;
    line(context, [left - 5, y], [left, y]);
    context.fillText(text, left - 8, y);
  }
  writeUpward(context, up.label, top + height / 2);
}

/** Writes the label of a vertical axis at the left edge, about its middle. */
export function writeUpward(context, label, middle) {
  context.save();
  context.translate(10 * letters(), middle);
  context.rotate(-Math.PI / 2);
  context.textAlign = "center";
  context.fillText(label, 0, 0);
  context.restore();
}

/**
 * Returns the label of an axis `name [unit]`, with a prefix that suits the range, and `[value, text]` of its marks.
 * Where these would have many digits, they are how far each is from the first, which the label has.
 */
function marked(label, [low, high], wanted) {
  const [, name, unit] = /^(.*) \[([^\]]*)\]$/.exec(label) ?? [null, label, ""];
  const suited = (largest) => (unit ? axisUnit(unit, largest) : [1, ""]);
  const [one, written] = suited(Math.max(Math.abs(low), Math.abs(high)));
  const found = apart(ticks([low / one, high / one], wanted));
  const marks = found.map(([value, text]) => [value * one, text]);
  if (!found.some(([, text]) => digits(text) > MOST_DIGITS)) return { label: axisLabel(name, written), marks };
  const [[first, text], [second]] = found;
  const [small, fine] = suited(high - low);
  const step = Number((((second - first) * one) / small).toPrecision(1)); // ticks are round numbers apart
  const from = `${text.startsWith("−") ? "+" : "−"} ${text.replace(/^−/, "")}${written && ` ${written}`}`;
  return {
    label: axisLabel(`${name} ${from}`, fine),
    marks: marks.map(([value], i) => [value, short(i * step)]),
  };
}

/** Returns how many digits of a written number count. */
function digits(text) {
  return text.replace(/e.*/, "").replace(/\D/g, "").replace(/^0+/, "").length;
}

function line(context, from, to) {
  context.beginPath();
  context.moveTo(...from);
  context.lineTo(...to);
  context.stroke();
}

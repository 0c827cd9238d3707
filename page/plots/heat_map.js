/** A map: a value over two parameters, as colours with a scale beside it. */

import { apart, axisUnit } from "../interface/numbers.js";
import { axisFont, extent } from "./axes.js";

// dark to light, evenly as the eye sees it (samples of matplotlib's viridis)
const SHADES = ["#440154", "#3b528b", "#21918c", "#5ec962", "#fde725"];

/** Draws cells about the points of two axes, and the scale of their colours. */
export function drawMap(context, to, [x, y], values, colours, unit) {
  const [low, high] = extent([values], 0);
  const [left, top, width, height] = to.room;
  const [columns, rows] = [different(x), different(y)];
  const [edgesX, edgesY] = [edges(columns), edges(rows)];
  values.forEach((value, i) => {
    const [column, row] = [columns.indexOf(x[i]), rows.indexOf(y[i])];
    const across = edgesX.slice(column, column + 2).map(to.x);
    const down = edgesY.slice(row, row + 2).map(to.y);
    context.fillStyle = Number.isFinite(value) ? shade((value - low) / (high - low || 1)) : colours.ground;
    context.fillRect(across[0], down[1], across[1] - across[0] + 0.6, down[0] - down[1] + 0.6);
  });
  const bar = left + width + 18;
  for (let i = 0; i < height; i++) {
    context.fillStyle = shade(1 - i / height);
    context.fillRect(bar, top + i, 14, 1.5);
  }
  context.fillStyle = colours.quiet;
  context.font = axisFont();
  context.textAlign = "left";
  context.textBaseline = "middle";
  const [one, written] = axisUnit(unit, Math.max(Math.abs(low), Math.abs(high)));
  const numbers = high > low ? [low, (low + high) / 2, high] : [low];
  for (const [value, text] of apart(numbers.map((number) => number / one))) {
    context.fillText(text, bar + 19, top + height * (1 - (value * one - low) / (high - low || 1)));
  }
  context.fillText(written, bar, top - 12);
}

/** Returns where the cells about an axis' values begin and end. */
export function cellsAbout(values) {
  const places = edges(different(values));
  return [places[0], places.at(-1)];
}

function different(values) {
  return [...new Set(values)].sort((a, b) => a - b);
}

function edges(values) {
  if (values.length === 1) return [values[0] - 0.5, values[0] + 0.5];
  const middles = values.slice(1).map((value, i) => (value + values[i]) / 2);
  return [2 * values[0] - middles[0], ...middles, 2 * values.at(-1) - middles.at(-1)];
}

function shade(share) {
  const place = Math.min(Math.max(share, 0), 1) * (SHADES.length - 1);
  const first = Math.min(Math.floor(place), SHADES.length - 2);
  const part = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
  const [a, b] = [part(SHADES[first]), part(SHADES[first + 1])];
  const mixed = a.map((one, i) => Math.round(one + (place - first) * (b[i] - one)));
  return `rgb(${mixed.join(" ")})`;
}

/** Clouds of points on a canvas, a million of them: darker where there are more. */

import { letters } from "./axes.js";

const FEW = 30000; // points below which each is a visible dot
const RADII = [[30, 3.2], [300, 2.2], [FEW / 10, 1.2], [FEW, 0.8]]; // px, of so many points at most
const LEAST = 0.35; // opacity of a single point among more of them

/**
 * Draws points in the colour of their layer, density as opacity.
 *
 * @param to scales of `axes.js`
 * @param layers `{x, y, colour}` with lists of numbers
 */
export function drawCloud(context, to, layers) {
  const dots = window.devicePixelRatio || 1;
  const [left, top, width, height] = to.room.map((one) => Math.round(one * dots));
  if (width < 1 || height < 1) return;
  const across = dots * letters();
  const total = layers.reduce((sum, { x }) => sum + x.length, 0);
  const [, radius] = RADII.find(([most]) => total <= most) ?? [0, 0];
  const size = radius ? Math.max(1, Math.round(radius * across)) : 0;
  const image = new ImageData(width, height);
  for (const { x, y, colour } of layers) {
    const counts = new Uint16Array(width * height);
    for (let i = 0; i < x.length; i++) {
      const column = Math.round(to.x(x[i]) * dots) - left;
      const row = Math.round(to.y(y[i]) * dots) - top;
      for (let r = row - size; r <= row + size; r++) {
        for (let c = column - size; c <= column + size; c++) {
          if ((c - column) ** 2 + (r - row) ** 2 > (size + 0.5) ** 2) continue;
          if (c >= 0 && r >= 0 && c < width && r < height) {
            const at = r * width + c;
            if (counts[at] < 65535) counts[at] += 1;
          }
        }
      }
    }
    blend(image.data, counts, rgb(context, colour), opacity(counts, total < FEW));
  }
  const layer = new OffscreenCanvas(width, height);
  layer.getContext("2d").putImageData(image, 0, 0);
  context.drawImage(layer, left / dots, top / dots, width / dots, height / dots);
}

/** Returns opacity by the number of points on a dot: one is seen, the densest place is opaque. */
function opacity(counts, few) {
  if (few) return (count) => 1 - 0.45 ** count;
  const most = counts.reduce((most, count) => Math.max(most, count), 1);
  return (count) => LEAST + ((1 - LEAST) * Math.log(count)) / (Math.log(most) || 1);
}

function blend(data, counts, [red, green, blue], opacityOf) {
  for (let i = 0; i < counts.length; i++) {
    if (!counts[i]) continue;
    const alpha = opacityOf(counts[i]);
    const at = 4 * i;
    const under = data[at + 3] / 255;
    data[at] = red * alpha + data[at] * (1 - alpha) * (under ? 1 : 0);
    data[at + 1] = green * alpha + data[at + 1] * (1 - alpha) * (under ? 1 : 0);
    data[at + 2] = blue * alpha + data[at + 2] * (1 - alpha) * (under ? 1 : 0);
    if (!under) [data[at], data[at + 1], data[at + 2]] = [red, green, blue];
    data[at + 3] = 255 * (alpha + under * (1 - alpha));
  }
}

function rgb(context, colour) {
  context.fillStyle = colour;
  const text = context.fillStyle; // #rrggbb, as the canvas writes it
  return [1, 3, 5].map((at) => parseInt(text.slice(at, at + 2), 16));
}

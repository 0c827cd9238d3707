/** What is drawn behind curves: impacts, and what lies beyond the horizon. */

import { palette } from "../mechanism/palette.js";

const MOST = 400; // impacts in a window; more would be a wall

/** Draws a short tick at the onset of each contact that is in the window. */
export function drawImpacts(plot, onsets) {
  const { min, max } = plot.scales.x;
  const shown = onsets.filter((onset) => onset >= min && onset <= max);
  if (shown.length > MOST) return;
  const { ctx, bbox } = plot;
  ctx.save();
  ctx.fillStyle = palette().play;
  for (const onset of shown) {
    const x = plot.valToPos(onset, "x", true);
    ctx.fillRect(x, bbox.top + bbox.height - 7 * devicePixelRatio, devicePixelRatio, 7 * devicePixelRatio);
  }
  ctx.restore();
}

/**
 * Shades what is beyond a horizon, and the spread of the extremes there.
 *
 * @param horizon s; null where there is none
 * @param extremes of the channel over companions, as the certificate has them; or undefined
 */
export function drawHorizon(plot, horizon, extremes) {
  if (horizon === null || horizon === undefined || horizon >= plot.scales.x.max) return;
  const { ctx, bbox } = plot;
  const left = Math.max(plot.valToPos(Math.max(horizon, plot.scales.x.min), "x", true), bbox.left);
  const width = bbox.left + bbox.width - left;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.globalAlpha = 0.13;
  ctx.fillStyle = palette().quiet;
  ctx.fillRect(left, bbox.top, width, bbox.height);
  ctx.fillStyle = palette().play;
  ctx.globalAlpha = 0.2;
  for (const [low, high] of spreads(extremes)) {
    const [top, bottom] = [high, low].map((value) => plot.valToPos(value, "y", true));
    ctx.fillRect(left, top, width, Math.max(bottom - top, devicePixelRatio));
  }
  ctx.restore();
}

function spreads(extremes) {
  if (!extremes) return [];
  const { lowest_minimum: a, highest_minimum: b, lowest_maximum: c, highest_maximum: d } = extremes;
  return [[a, b], [c, d]].filter(([low, high]) => low !== null && high !== null);
}

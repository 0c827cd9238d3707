/** What is drawn behind curves: impacts, and where the motion is not converged. */

import { gaps } from "../interface/converged.js";
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
 * Shades where the motion is not converged, and the spread of the extremes there.
 *
 * @param certificate of the run; or nothing
 * @param extremes of the channel over companions, as the certificate has them; or undefined
 */
export function drawUnconverged(plot, certificate, extremes) {
  if (!certificate) return;
  const { min, max } = plot.scales.x;
  for (const [begin, end] of gaps(certificate, min, max)) {
    const [left, right] = [begin, end].map((time) => plot.valToPos(time, "x", true));
    shade(plot, left, Math.max(right - left, devicePixelRatio), extremes);
  }
}

function shade(plot, left, width, extremes) {
  const { ctx, bbox } = plot;
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

/** Curves through points over one parameter, and bands between two curves. */

const RADIUS = 2.5; // px of a point

/**
 * Draws curves in the order of x; NaN interrupts them.
 *
 * @param to scales of `axes.js`
 * @param x values of the parameter
 * @param curves `{values, colour}`, or `{low, high, colour}` for a band
 */
export function drawCurves(context, to, x, curves) {
  const order = x.map((_, i) => i).sort((a, b) => x[a] - x[b]);
  for (const { values, low, high, colour } of curves) {
    context.fillStyle = colour;
    context.strokeStyle = colour;
    context.lineWidth = 1.3;
    if (low) band(context, to, x, order, low, high);
    else line(context, to, x, order, values);
  }
}

function line(context, to, x, order, values) {
  context.beginPath();
  let joined = false;
  for (const i of order) {
    const known = Number.isFinite(values[i]);
    if (known) context[joined ? "lineTo" : "moveTo"](to.x(x[i]), to.y(values[i]));
    joined = known;
  }
  context.stroke();
  for (const i of order) {
    if (!Number.isFinite(values[i])) continue;
    context.beginPath();
    context.arc(to.x(x[i]), to.y(values[i]), RADIUS, 0, 2 * Math.PI);
    context.fill();
  }
}

function band(context, to, x, order, low, high) {
  const known = order.filter((i) => Number.isFinite(low[i]) && Number.isFinite(high[i]));
  context.globalAlpha = 0.22;
  context.beginPath();
  for (const i of known) context.lineTo(to.x(x[i]), to.y(high[i]));
  for (const i of known.reverse()) context.lineTo(to.x(x[i]), to.y(low[i]));
  context.fill();
  context.globalAlpha = 1;
}

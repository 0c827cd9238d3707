/** What the points of a diagram were judged to be: a band of verdicts, and exponents. */

/** Verdicts, each of which has a colour of its own in the style sheet. */
export const VERDICTS = ["periodic", "quasi-periodic", "chaotic", "equilibrium", "undecided"];

/** Draws a band in the colours of the verdicts; of two directions forward is the upper half. */
export function drawVerdicts(context, to, points, colours) {
  const values = points.map(({ value }) => value);
  const [left, top, width, height] = to.room;
  const wide = Math.max(1.5, (width / new Set(values).size) * 0.98);
  const half = new Set(points.map(({ backward }) => backward)).size > 1 ? height / 2 : height;
  for (const { value, verdict, backward } of points) {
    if (!verdict) continue;
    const [from, until] = [-wide, wide].map((one) =>
      Math.min(Math.max(to.x(value) + one / 2, left), left + width));
    context.fillStyle = colours[verdict] ?? colours.faint;
    context.fillRect(from, backward && half < height ? top + half : top, until - from, half);
  }
}

/** Draws largest exponents, bars of their standard errors, and where they are zero. */
export function drawExponents(context, to, points, colours) {
  const [left, , width] = to.room;
  context.strokeStyle = colours.faint;
  context.setLineDash([4, 3]);
  context.beginPath();
  context.moveTo(left, to.y(0));
  context.lineTo(left + width, to.y(0));
  context.stroke();
  context.setLineDash([]);
  for (const { value, exponent, error, backward } of points) {
    if (exponent === null) continue;
    context.fillStyle = colours[backward ? "backward" : "curve-0"];
    context.fillRect(to.x(value) - 1.5, to.y(exponent) - 1.5, 3, 3);
    const [high, low] = [exponent + error, exponent - error].map(to.y);
    context.fillRect(to.x(value) - 0.5, high, 1, low - high);
  }
}

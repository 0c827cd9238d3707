/** What the points of a diagram were judged to be: a band of verdicts, and exponents. */

export const VERDICTS = {
  periodic: "curve-0", "quasi-periodic": "curve-2", chaotic: "curve-1", undecided: "faint",
};

/** Draws a band in the colours of the verdicts. */
export function drawVerdicts(context, to, points, colours) {
  const values = points.map(({ value }) => value);
  const [left, top, width, height] = to.room;
  const wide = Math.max(1.5, (width / new Set(values).size) * 0.98);
  for (const { value, verdict } of points) {
    if (!verdict) continue;
    context.fillStyle = colours[VERDICTS[verdict]] ?? colours.faint;
    context.fillRect(Math.max(left, to.x(value) - wide / 2), top, wide, height);
  }
}

/** Draws largest exponents, and where they are zero. */
export function drawExponents(context, to, points, colours) {
  const [left, , width] = to.room;
  context.strokeStyle = colours.faint;
  context.setLineDash([4, 3]);
  context.beginPath();
  context.moveTo(left, to.y(0));
  context.lineTo(left + width, to.y(0));
  context.stroke();
  context.setLineDash([]);
  for (const { value, exponent } of points) {
    if (exponent === null) continue;
    context.fillStyle = exponent > 0 ? colours["curve-1"] : colours["curve-0"];
    context.fillRect(to.x(value) - 1.5, to.y(exponent) - 1.5, 3, 3);
  }
}

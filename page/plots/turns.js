/** Angles within one turn: what goes round is where it was after each whole turn. */

const TURN = 2 * Math.PI;

/**
 * Returns what takes angles [rad] into one turn, or leaves them if they reach over no more than one.
 *
 * The turn has the middle of the angles, to a quarter of a turn, in its own middle: angles that are
 * equal but for rounding do not come apart at its ends.
 */
export function intoATurn(angles) {
  let [low, high, sine, cosine] = [Infinity, -Infinity, 0, 0];
  for (const angle of angles) {
    if (!Number.isFinite(angle)) continue;
    low = Math.min(low, angle);
    high = Math.max(high, angle);
    sine += Math.sin(angle);
    cosine += Math.cos(angle);
  }
  if (!(high - low > TURN)) return (angle) => angle;
  const middle = (Math.round(Math.atan2(sine, cosine) / (TURN / 4)) * TURN) / 4;
  return (angle) => angle - TURN * Math.round((angle - middle) / TURN);
}

/** Stretches of time that are shown in a film: so many seconds of film, or from impact to impact. */

import { span } from "../interface/numbers.js";

export const LENGTHS = { 4: "4 s", 12: "12 s", 30: "30 s", impact: "impact to impact" };
const LONGEST = 60; // s of film

/**
 * Returns the stretch that is shown at a clock's speed: `{from, seconds, speed}`, with `from` in
 * simulated time and `seconds` of film.
 *
 * @param length one of `LENGTHS`: seconds of film from the time that is shown on, at most until the
 *   end; or from the impact before that time to the one after it
 * @param onsets of impacts, s, sorted
 */
export function stretch(length, clock, onsets) {
  const { speed } = clock;
  if (length !== "impact") {
    const from = clock.time < clock.last ? clock.time : clock.first;
    return { from, seconds: Math.min(Number(length), (clock.last - from) / speed), speed };
  }
  const after = onsets.findIndex((onset) => onset > clock.time);
  if (after < 1) throw new Error("No impact is on both sides of the time that is shown; choose another time.");
  const [from, until] = [onsets[after - 1], onsets[after]];
  const seconds = (until - from) / speed;
  if (seconds > LONGEST) {
    throw new Error(`From impact to impact takes ${span(seconds)} at this speed; choose a faster one.`);
  }
  return { from, seconds, speed };
}

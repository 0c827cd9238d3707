/** A duration in which something of a mechanism can be seen. */

import { bounds } from "../mechanism/bounds.js";
import { withParameters } from "../mechanism/parameters.js";
import { poses } from "../requests/poses.js";
import { Problem } from "../requests/service.js";

const WITHOUT_TURNING = 0.05; // s, of mechanisms that neither turn nor fall
const TURNS = 4; // of the slowest driver
const SWINGS = 20; // in times of a fall through the mechanism

/**
 * Returns a duration in s in which something can be seen: some turns, or some swings.
 *
 * @param found what the service answers of the scene's pose
 */
export function someDuration(document, { poses: [pose], curves, drivers_time: once, repeats }) {
  if (document.reported?.length) return document.reported[0].duration;
  if (once !== null) return rounded(repeats ? TURNS * once : once);
  const scene = { ...withParameters(document), curves };
  const gravity = Math.hypot(...(scene.gravity ?? [0, 0]));
  if (!gravity || !pose) return WITHOUT_TURNING;
  const [left, low, right, high] = bounds(scene, [pose]);
  return rounded(SWINGS * Math.sqrt(Math.hypot(right - left, high - low) / gravity));
}

/** Returns `someDuration` of a scene, for which the service is asked. */
export async function proposedDuration(document, signal) {
  if (document.reported?.length) return document.reported[0].duration;
  try {
    return someDuration(document, await poses(withParameters(document), [0], signal));
  } catch (error) {
    if (!(error instanceof Problem) || error.status === 401) throw error;
    return WITHOUT_TURNING; // what is wrong with the scene is told when it is run
  }
}

/** Returns a value with two digits, as forms propose it. */
export function rounded(value) {
  return Number(value.toPrecision(2));
}

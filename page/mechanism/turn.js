/** How long the drivers of a scene take to turn, for the speed at which a run is shown. */

import { marks } from "./placing.js";

/** Returns the seconds in which the slowest driver turns or swings once; null where none does. */
export function turn({ drivers = {}, joints }) {
  const speeds = Object.values(drivers).map(({ joint, speed, motion }) => {
    if (motion) return motion.type === "sinusoidal" ? motion.frequency : 0;
    return joints[joint] && !marks(joints[joint]).turns ? 0 : Math.abs(speed);
  });
  const slowest = Math.min(...speeds.filter((speed) => speed > 0));
  return Number.isFinite(slowest) ? (2 * Math.PI) / slowest : null;
}

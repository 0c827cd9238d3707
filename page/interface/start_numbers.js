/** Numbers of a scene's start that a study may vary instead of a parameter, by their JSON pointers. */

import { withParameters } from "../mechanism/parameters.js";
import { marks, play } from "../mechanism/placing.js";

const XY = ["x", "y"];
const SHARE = 0.9; // of a play, up to which journals start
const RATE = 0.1; // m/s
const TURN = 6.283;

/**
 * Returns by pointer the name of each number, and a range to begin with: `{name, from, to}`.
 *
 * These are places and speeds of journals in their play, angles and angular velocities of bodies that
 * the scene starts at, and positions of drivers. Others can be written in a job's document.
 */
export function startNumbers(document) {
  const { joints, start, drivers } = withParameters(document);
  const found = {};
  const add = (pointer, name, middle, width) => {
    found[pointer] = { name, from: middle - width, to: middle + width };
  };
  for (const [name, joint] of Object.entries(joints)) {
    if (!marks(joint).is_journal || !(play(joint) > 0)) continue;
    XY.forEach((axis, k) => add(`/start/joints/${name}/eccentricity/${k}`, `${name}.eccentricity_${axis}`,
      0, SHARE * play(joint)));
    XY.forEach((axis, k) => add(`/start/joints/${name}/rate/${k}`, `${name}.eccentricity_rate_${axis}`, 0, RATE));
  }
  for (const name of Object.keys(drivers ?? {})) add(`/drivers/${name}/position`, `${name}.position`, TURN / 2, TURN / 2);
  for (const [name, angle] of Object.entries(start?.angles ?? {})) {
    add(`/start/angles/${name}`, `${name}.angle`, angle, 1);
    add(`/start/angular_velocities/${name}`, `${name}.angular_velocity`, start.angular_velocities?.[name] ?? 0, 1);
  }
  return found;
}

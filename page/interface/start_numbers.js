/** Numbers of a scene's start that a study may vary instead of a parameter, by their JSON pointers. */

import { withParameters } from "../mechanism/parameters.js";
import { marks, play } from "../mechanism/placing.js";

const XY = ["x", "y"];
const SHARE = 0.9; // of a play, up to which journals start
const RATE = 0.1; // m/s
const TURN = 6.283;
const STROKE = 0.01; // m

// what stands in a pointer beside the name of a body, joint or driver
const NUMBERS = {
  angles: ["angle", "rad"],
  points: ["position", "m"],
  angular_velocities: ["angular_velocity", "rad/s"],
  velocities: ["velocity", "m/s"],
  "joints eccentricity": ["eccentricity", "m"],
  "joints rate": ["eccentricity_rate", "m/s"],
  "guides offset": ["offset", "m"],
  "guides tilt": ["tilt", "rad"],
  "guides rate": ["offset_rate", "m/s"],
  "guides tilt_rate": ["tilt_rate", "rad/s"],
  "drivers position": ["position", "1"], // rad, or m if it slides
};

/** Returns the name and unit of a number by its pointer: `stop.eccentricity_x` in m. */
export function startNumber(pointer) {
  const [part, name, ...field] = pointer.split("/").slice(pointer.startsWith("/start/") ? 2 : 1);
  const axis = XY[field.at(-1)];
  if (axis) field.pop();
  const [word, unit] = NUMBERS[[part, ...field].join(" ")] ?? [pointer, "1"];
  return { name: `${name}.${word}${axis ? `_${axis}` : ""}`, unit };
}

/** Returns the bodies that a driver turns against the ground. */
function movedBy({ joint, body }, joints) {
  if (body) return [body];
  const ends = Object.values(joints[joint] ?? {}).filter((one) => typeof one === "string" && one.includes("."));
  const bodies = ends.map((one) => one.split(".")[0]);
  return bodies.includes("ground") ? bodies : [];
}

/**
 * Returns by pointer the name and unit of each number, and a range to begin with: `{name, unit, from,
 * to}`; what moves and its speed stand side by side.
 *
 * These are positions and speeds of journals in their play, angles and angular velocities of bodies that
 * the scene starts at and no driver turns, and positions of drivers. Others can be written in a job's document.
 */
export function startNumbers(document) {
  const { joints, start, drivers } = withParameters(document);
  const found = {};
  const add = (pointer, middle, width, unit = startNumber(pointer).unit) => {
    found[pointer] = { ...startNumber(pointer), unit, from: middle - width, to: middle + width };
  };
  for (const [name, joint] of Object.entries(joints)) {
    if (!marks(joint).is_journal || !(play(joint) > 0)) continue;
    for (const k of XY.keys()) {
      add(`/start/joints/${name}/eccentricity/${k}`, 0, SHARE * play(joint));
      add(`/start/joints/${name}/rate/${k}`, 0, RATE);
    }
  }
  const moved = new Set(Object.values(drivers ?? {}).flatMap((one) => movedBy(one, joints)));
  for (const [name, angle] of Object.entries(start?.angles ?? {})) {
    if (moved.has(name)) continue;
    add(`/start/angles/${name}`, angle, 1);
    add(`/start/angular_velocities/${name}`, start.angular_velocities?.[name] ?? 0, 1);
  }
  for (const [name, { joint, position }] of Object.entries(drivers ?? {})) {
    const slides = joint && !marks(joints[joint]).turns; // without a joint it turns a body
    const range = slides ? [position ?? 0, STROKE, "m"] : [TURN / 2, TURN / 2, "rad"];
    add(`/drivers/${name}/position`, ...range);
  }
  return found;
}

/**
 * Positions of bodies and points in the world, in m and rad.
 *
 * A pose gives by body `[x, y, theta]`: its centre of mass and its angle.
 */

import { MARKS } from "./joint_marks.js"; // the service makes it

export const GROUND = "ground";
const UNKNOWN = { ends: [], parts: {} }; // a type that is being written

/** Returns the marks by which a joint is drawn, as its type gives them to the service. */
export function marks(joint) {
  return MARKS[joint.type] ?? UNKNOWN;
}

/** Returns the two references `body.point` that a joint holds together. */
export function ends(joint) {
  return marks(joint).ends.map((field) => joint[field]);
}

/** Returns body and own coordinates of a reference such as `rod.crank`. */
export function reference(scene, text) {
  const [body, point] = String(text).split(".");
  const owner = body === GROUND ? scene.ground : scene.bodies?.[body];
  const at = owner?.points?.[point];
  if (!at) throw new Error(`There is no point “${text}”.`);
  return { body, at };
}

/** Returns where a point of a body, in the body's coordinates, is in the world. */
export function world(pose, body, [x, y]) {
  if (body === GROUND) return [x, y];
  const [px, py, angle] = pose[body];
  const c = Math.cos(angle);
  const s = Math.sin(angle);
  return [px + c * x - s * y, py + s * x + c * y];
}

/** Returns the position of a reference such as `rod.crank` in the world. */
export function placeOf(scene, pose, text) {
  const { body, at } = reference(scene, text);
  return world(pose, body, at);
}

/** Returns the play of a joint in m; 0 of an ideal one. */
export function play(joint) {
  return joint.clearance?.[marks(joint).play] ?? 0;
}

/** Returns the angle in the world of the axis of a joint that slides. */
export function heading(pose, joint) {
  const [x, y] = joint[marks(joint).axis];
  return angleOf(pose, ends(joint)[0]) + Math.atan2(y, x);
}

/** Returns the angle in the world of the body of a reference such as `rod.crank`. */
export function angleOf(pose, text) {
  const [body] = text.split(".");
  return body === GROUND ? 0 : pose[body][2];
}

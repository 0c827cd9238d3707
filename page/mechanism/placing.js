/**
 * Places of bodies and points in the world, in m and rad.
 *
 * A pose gives by body `[x, y, theta]`: its centre of mass and its angle.
 */

export const GROUND = "ground";
const ENDS = {
  revolute: ["bearing", "journal"],
  prismatic: ["guide", "slider"],
  "pin-in-slot": ["slot", "pin"],
  fixed: ["base", "part"],
  "flat-follower": ["cam", "follower"],
  "roller-follower": ["cam", "follower"],
};

/** Returns the two references `body.point` that a joint holds together. */
export function ends(joint) {
  return (ENDS[joint.type] ?? []).map((field) => joint[field]);
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

/** Returns the place of a reference such as `rod.crank` in the world. */
export function placeOf(scene, pose, text) {
  const { body, at } = reference(scene, text);
  return world(pose, body, at);
}

/** Returns the play of a joint in m; 0 of an ideal one. */
export function play(joint) {
  const clearance = joint.clearance;
  return clearance?.radial_clearance ?? clearance?.wall_clearance ?? clearance?.lash ?? 0;
}

/** Returns the angle in the world of the axis of a joint that slides. */
export function heading(pose, joint) {
  const owner = ends(joint)[0].split(".")[0];
  return (owner === GROUND ? 0 : pose[owner][2]) + Math.atan2(joint.axis[1], joint.axis[0]);
}

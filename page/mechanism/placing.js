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
  return clearance?.radial_clearance ?? clearance?.wall_clearance ?? 0;
}

/** Returns the smallest box around all points of poses: `[left, low, right, high]`. */
export function bounds(scene, poses) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  const include = ([x, y]) => {
    box[0] = Math.min(box[0], x);
    box[1] = Math.min(box[1], y);
    box[2] = Math.max(box[2], x);
    box[3] = Math.max(box[3], y);
  };
  for (const pose of poses) {
    for (const [body, { points = {} }] of Object.entries(scene.bodies)) {
      include(pose[body]);
      for (const point of Object.values(points)) include(world(pose, body, point));
    }
  }
  for (const joint of Object.values(scene.joints)) {
    for (const end of ends(joint)) {
      const { body, at } = reference(scene, end);
      if (body === GROUND && joint.type !== "prismatic") include(at);
    }
  }
  for (const { stiffness, first, second } of Object.values(scene.forces ?? {})) {
    if (!stiffness || !first || !second) continue;
    for (const pose of poses) for (const end of [first, second]) include(placeOf(scene, pose, end));
  }
  if (box[2] - box[0] + box[3] - box[1] < 1e-12) {
    const radius = 3 * Math.max(...Object.values(scene.joints).map(ownRadius), 1e-3);
    return [box[0] - radius, box[1] - radius, box[2] + radius, box[3] + radius];
  }
  return box;
}

function ownRadius({ clearance }) {
  return clearance?.bearing_radius ?? clearance?.pin_radius ?? clearance?.height ?? 0;
}

/** How far a mechanism reaches. */

import { curves } from "./curves.js";
import { guides } from "./guides.js";
import { GROUND, ends, marks, placeOf, reference, world } from "./placing.js";

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
      if (body === GROUND && marks(joint).sign) include(at);
    }
  }
  for (const pose of poses) {
    for (const { points } of curves(scene, pose)) points.forEach(include);
  }
  const extent = Math.max(box[2] - box[0], box[3] - box[1]);
  for (const pose of poses) {
    for (const { slider, walls } of guides(scene, pose, extent)) [slider, ...walls].flat().forEach(include);
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

function ownRadius(joint) {
  return joint.clearance?.[marks(joint).size] ?? 0;
}

/** Curves that joints are drawn by, placed in the world: outlines of cams, faces, rollers. */

import { reference, world } from "./placing.js";

/** Returns for each curve of a scene its `points` in the world, and whether it is `filled`. */
export function curves(scene, pose) {
  return (scene.curves ?? []).map(({ about, filled, points }) => {
    const { body, at: [x, y] } = reference(scene, about);
    return { filled, points: points.map(([dx, dy]) => world(pose, body, [x + dx, y + dy])) };
  });
}

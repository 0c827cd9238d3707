/** Guides with play: the walls that a slider has room between, and the slider itself. */

import { ends, heading, marks, placeOf, play } from "./placing.js";

const SHORTEST = 0.1; // length of a slider in extents of the mechanism; shorter ones are drawn larger
const WALLS = 2.2; // length of the walls in lengths of the slider
const CORNERS = [[1, 1], [-1, 1], [-1, -1], [1, -1]];

/**
 * Returns each guide with play as its `slider`, four corners, and its two `walls`, in the world.
 *
 * How a slider tilts within its play is too small to be seen here.
 */
export function guides(scene, pose, extent) {
  return Object.values(scene.joints)
    .filter((joint) => marks(joint).block && play(joint) > 0)
    .map((joint) => {
      const [length, height] = marks(joint).block.map((field) => joint.clearance[field]);
      const angle = heading(pose, joint);
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      const larger = Math.max(1, (SHORTEST * extent) / length);
      const half = [0.5 * larger * length, 0.5 * larger * height];
      const [origin, centre] = ends(joint).map((end) => placeOf(scene, pose, end));
      const way = (centre[0] - origin[0]) * c + (centre[1] - origin[1]) * s;
      const middle = [origin[0] + way * c, origin[1] + way * s];
      const from = ([x, y], along, across) => [x + along * c - across * s, y + along * s + across * c];
      const wall = half[1] + larger * play(joint);
      return {
        slider: CORNERS.map(([a, b]) => from(centre, a * half[0], b * half[1])),
        walls: [1, -1].map((side) =>
          [-1, 1].map((end) => from(middle, end * WALLS * half[0], side * wall))),
      };
    });
}

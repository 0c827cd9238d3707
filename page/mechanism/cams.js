/** Outlines of cams, from the profiles of a scene, with the faces and rollers that they move. */

import { play, reference, world } from "./placing.js";
import { profileAt, slopeAt } from "./profile.js";

const STEPS = 180; // of a turn
const FACE = 0.6; // half the length of a face that is drawn, in means of the profile
const ANGLES = Array.from({ length: STEPS + 1 }, (_, i) => (2 * Math.PI * i) / STEPS);

/** Returns for each cam of a scene its `outline` and what it has `moved`, as points in the world. */
export function cams(scene, pose) {
  return Object.values(scene.joints)
    .filter(({ type }) => type.endsWith("follower"))
    .map((joint) => {
      const values = ANGLES.map((angle) => profileAt(joint.profile, angle));
      const slopes = ANGLES.map((angle) => slopeAt(joint.profile, angle));
      const [cam, follower] = [joint.cam, joint.follower].map((end) => reference(scene, end));
      const around = ({ body, at: [x, y] }, curve) =>
        curve.map(([dx, dy]) => world(pose, body, [x + dx, y + dy]));
      const isFlat = joint.type === "flat-follower";
      const outline = ANGLES.map((angle, i) => {
        const [c, s] = [Math.cos(angle), Math.sin(angle)];
        const [value, rise] = [values[i], slopes[i]];
        if (isFlat) {
          const reach = value - play(joint);
          return [reach * c - rise * s, reach * s + rise * c];
        }
        const inside = (joint.roller_radius + play(joint)) / Math.hypot(value, rise);
        return [value * c - inside * (value * c + rise * s), value * s - inside * (value * s - rise * c)];
      });
      const moved = isFlat ? face(joint, values) : ANGLES.map((angle) =>
        [joint.roller_radius * Math.cos(angle), joint.roller_radius * Math.sin(angle)]);
      return { outline: around(cam, outline), moved: around(follower, moved) };
    });
}

function face({ normal: [x, y] }, values) {
  const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
  const share = (FACE * mean) / Math.hypot(x, y);
  return [[share * y, -share * x], [-share * y, share * x]];
}

/** Outlines of cams, from the profiles of a scene, with the faces and rollers that they move. */

import { GROUND, ends, marks, placeOf, play, reference, world } from "./placing.js";
import { profileAt, slopeAt } from "./profile.js";

const STEPS = 180; // of a turn
const FACE = 0.6; // half the length of a face that is drawn, in means of the profile
export const ANGLES = Array.from({ length: STEPS + 1 }, (_, i) => (2 * Math.PI * i) / STEPS);

/**
 * Returns for each cam of a scene its `outline` and what it has `moved`, and for each other circle
 * that a joint is drawn by what is `moved` alone, as points in the world.
 */
export function cams(scene, pose) {
  return Object.values(scene.joints).flatMap((joint) => {
    const { cam, circles } = marks(joint);
    const at = ends(joint).map((end) => reference(scene, end));
    const around = ({ body, at: [x, y] }, curve) =>
      curve.map(([dx, dy]) => world(pose, body, [x + dx, y + dy]));
    const moved = circles.map(([end, radius]) => around(at[end], ANGLES.map((angle) =>
      [joint[radius] * Math.cos(angle), joint[radius] * Math.sin(angle)])));
    if (cam.face) moved.unshift(around(at[1], face(joint)));
    const found = moved.map((curve) => ({ moved: curve }));
    if (!cam.profile) return found;
    const outline = around(at[0], ANGLES.map((angle) => surfaceAt(joint, angle).point));
    return [{ outline, ...found[0] }, ...found.slice(1)];
  });
}

/**
 * Returns where a cam ends, `{point, normal}` in its axes about its centre, the normal outwards:
 * there the follower touches it that has this angle of the profile.
 */
export function surfaceAt(joint, angle) {
  const { cam } = marks(joint);
  const profile = joint[cam.profile];
  const [value, slope] = [profileAt(profile, angle), slopeAt(profile, angle)];
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  if (cam.face) {
    const reach = value - play(joint);
    return { point: [reach * c - slope * s, reach * s + slope * c], normal: [c, s] };
  }
  const size = Math.hypot(value, slope);
  const normal = [(value * c + slope * s) / size, (value * s - slope * c) / size];
  const inside = joint[cam.roller] + play(joint);
  return { point: [value * c - inside * normal[0], value * s - inside * normal[1]], normal };
}

/** Returns the angle in the world of a cam's axes, and in these that of its follower. */
export function camAngles(scene, joint, pose) {
  const angleOf = (end) => {
    const { body } = reference(scene, end);
    return body === GROUND ? 0 : pose[body][2];
  };
  const [cam, follower] = ends(joint);
  const turned = angleOf(cam);
  if (marks(joint).cam.face) {
    const [x, y] = joint[marks(joint).cam.face];
    return { turned, angle: Math.atan2(y, x) + angleOf(follower) - turned };
  }
  const [from, to] = [cam, follower].map((end) => placeOf(scene, pose, end));
  return { turned, angle: Math.atan2(to[1] - from[1], to[0] - from[0]) - turned };
}

/** Returns the mean of a cam's profile over a turn, m. */
export function meanProfile(joint) {
  const profile = joint[marks(joint).cam.profile];
  return ANGLES.slice(1).reduce((sum, angle) => sum + profileAt(profile, angle), 0) / STEPS;
}

function face(joint) {
  const [x, y] = joint[marks(joint).cam.face];
  const share = (FACE * meanProfile(joint)) / Math.hypot(x, y);
  return [[share * y, -share * x], [-share * y, share * x]];
}

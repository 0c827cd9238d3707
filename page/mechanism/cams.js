/** Outlines of cams, from the profiles of a scene, with the faces and rollers that they move. */

import { GROUND, placeOf, play, reference, world } from "./placing.js";
import { profileAt, slopeAt } from "./profile.js";

const STEPS = 180; // of a turn
const FACE = 0.6; // half the length of a face that is drawn, in means of the profile
export const ANGLES = Array.from({ length: STEPS + 1 }, (_, i) => (2 * Math.PI * i) / STEPS);

/** Returns for each cam of a scene its `outline` and what it has `moved`, as points in the world. */
export function cams(scene, pose) {
  return Object.values(scene.joints)
    .filter(({ type }) => type.endsWith("follower"))
    .map((joint) => {
      const [cam, follower] = [joint.cam, joint.follower].map((end) => reference(scene, end));
      const around = ({ body, at: [x, y] }, curve) =>
        curve.map(([dx, dy]) => world(pose, body, [x + dx, y + dy]));
      const outline = ANGLES.map((angle) => surfaceAt(joint, angle).point);
      const moved = joint.type === "flat-follower" ? face(joint) : ANGLES.map((angle) =>
        [joint.roller_radius * Math.cos(angle), joint.roller_radius * Math.sin(angle)]);
      return { outline: around(cam, outline), moved: around(follower, moved) };
    });
}

/**
 * Returns where a cam ends, `{point, normal}` in its axes about its centre, the normal outwards:
 * there the follower touches it that has this angle of the profile.
 */
export function surfaceAt(joint, angle) {
  const [value, slope] = [profileAt(joint.profile, angle), slopeAt(joint.profile, angle)];
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  if (joint.type === "flat-follower") {
    const reach = value - play(joint);
    return { point: [reach * c - slope * s, reach * s + slope * c], normal: [c, s] };
  }
  const size = Math.hypot(value, slope);
  const normal = [(value * c + slope * s) / size, (value * s - slope * c) / size];
  const inside = joint.roller_radius + play(joint);
  return { point: [value * c - inside * normal[0], value * s - inside * normal[1]], normal };
}

/** Returns the angle in the world of a cam's axes, and in these that of its follower. */
export function camAngles(scene, joint, pose) {
  const angleOf = (end) => {
    const { body } = reference(scene, end);
    return body === GROUND ? 0 : pose[body][2];
  };
  const turned = angleOf(joint.cam);
  if (joint.type === "flat-follower") {
    const [x, y] = joint.normal;
    return { turned, angle: Math.atan2(y, x) + angleOf(joint.follower) - turned };
  }
  const [from, to] = [joint.cam, joint.follower].map((end) => placeOf(scene, pose, end));
  return { turned, angle: Math.atan2(to[1] - from[1], to[0] - from[0]) - turned };
}

/** Returns the mean of a cam's profile over a turn, m. */
export function meanProfile({ profile }) {
  return ANGLES.slice(1).reduce((sum, angle) => sum + profileAt(profile, angle), 0) / STEPS;
}

function face(joint) {
  const [x, y] = joint.normal;
  const share = (FACE * meanProfile(joint)) / Math.hypot(x, y);
  return [[share * y, -share * x], [-share * y, share * x]];
}

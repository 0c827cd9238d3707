/** A follower on its cam, magnified where they touch, as they stand in the world. */

import { ANGLES, camAngles, meanProfile, surfaceAt } from "./cams.js";
import { DEEPEST, GAP, arrow, disc, polygon, shown } from "./magnified.js";
import { marks, play } from "./placing.js";

const CAM = 78; // mean of a profile under a flat face, px
const ROLLER = 48; // radius, px
const FACE = { half: 105, thick: 26 }; // half its length, px
const FARTHEST = 2 * GAP; // where a follower is drawn that has lifted off farther, px

/**
 * Returns the shapes of a joint, and by what its gap and penetration are exaggerated.
 *
 * @param contact penetration and force now
 * @param limits the `strongest` force, N, and the `deepest` penetration, m
 */
export function follower(scene, joint, pose, contact, limits) {
  const lash = play(joint);
  const { cam } = marks(joint);
  const isFlat = Boolean(cam.face);
  const drawn = isFlat ? meanProfile(joint) / CAM : joint[cam.roller] / ROLLER; // m of a px
  const { turned, angle } = camAngles(scene, joint, pose);
  const [c, s] = [Math.cos(turned), Math.sin(turned)];
  const seen = ([x, y]) => [c * x - s * y, -s * x - c * y];
  const touched = surfaceAt(joint, angle);
  const outline = ANGLES.map((off) => surfaceAt(joint, angle + off).point.map((one, i) =>
    (one - touched.point[i]) / drawn));
  const [nx, ny] = seen(touched.normal);
  const apart = Math.min(GAP - shown(contact.penetration + lash, lash, limits), FARTHEST);
  const tip = [apart * nx, apart * ny];
  const look = { fill: "tint-0", stroke: "edge", width: 1.4 };
  const corner = ([along, away]) =>
    [tip[0] - along * ny + away * nx, tip[1] + along * nx + away * ny];
  const { half, thick } = FACE;
  const shapes = [
    polygon(outline.map(seen), { fill: "ground", stroke: "edge", width: 1.4 }),
    isFlat
      ? polygon([[-half, 0], [half, 0], [half, thick], [-half, thick]].map(corner), look)
      : disc(corner([0, ROLLER]), ROLLER, look),
    ...arrow(tip, [-nx, -ny], contact.normal_force, limits),
  ];
  return { shapes, exaggerated: (GAP * drawn) / lash, deeper: (DEEPEST * drawn) / limits.deepest };
}

/** A follower on its cam, magnified where they touch, as they stand in the world. */

import { DEEPEST, GAP, arrow, disc, polygon, shown } from "./magnified.js";
import { angleOf, placeOf, play } from "./placing.js";

const ROLLER = 48; // radius, px; the scale of a flat face is that of half its length
const FACE = { half: 105, thick: 26 }; // half its length, px
const FARTHEST = 2 * GAP; // where a follower is drawn that has lifted off farther, px

/**
 * Returns the shapes of a joint, and by what its gap and penetration are exaggerated.
 *
 * @param scene with its curves: of the joint the outline of the cam, whose points are uniform in
 *   the angle of the profile, and the face, two points, or the roller
 * @param contact penetration and force now
 * @param limits the `strongest` force, N, and the `deepest` penetration, m
 */
export function follower(scene, name, pose, contact, limits) {
  const lash = play(scene.joints[name]);
  const [cam, moved] = scene.curves.filter(({ joint }) => joint === name);
  const isFlat = moved.points.length === 2;
  const drawn = Math.hypot(...moved.points[0]) / ROLLER; // m of a px
  const turn = angleOf(pose, cam.about);
  const angle = faced(scene, pose, cam, moved) - turn;
  const [c, s] = [Math.cos(turn), Math.sin(turn)];
  const seen = ([x, y]) => [(c * x - s * y) / drawn, (-s * x - c * y) / drawn];
  const step = (2 * Math.PI) / (cam.points.length - 1);
  const [before, touched, after] = [-1, 0, 1].map((off) => on(cam.points, angle / step + off));
  const outline = cam.points.map((point) => seen(less(point, touched)));
  const [along, down] = seen(less(after, before));
  const [nx, ny] = [-down, along].map((one) => one / Math.hypot(along, down));
  const apart = Math.min(GAP - shown(contact.penetration + lash, lash, limits), FARTHEST);
  const tip = [apart * nx, apart * ny];
  const look = { fill: "tint-0", stroke: "edge", width: 1.4 };
  const corner = ([along, away]) =>
    [tip[0] - along * ny + away * nx, tip[1] + along * nx + away * ny];
  const { half, thick } = FACE;
  const shapes = [
    polygon(outline, { fill: "ground", stroke: "edge", width: 1.4 }),
    isFlat
      ? polygon([[-half, 0], [half, 0], [half, thick], [-half, thick]].map(corner), look)
      : disc(corner([0, ROLLER]), ROLLER, look),
    ...arrow(tip, [-nx, -ny], contact.normal_force, limits),
  ];
  return { shapes, exaggerated: (GAP * drawn) / lash, deeper: (DEEPEST * drawn) / limits.deepest };
}

/** Returns the direction in the world of a face's normal, or of a roller from the cam's centre. */
function faced(scene, pose, cam, { about, points }) {
  if (points.length === 2) {
    const [x, y] = less(points[1], points[0]);
    return Math.atan2(-x, y) + angleOf(pose, about);
  }
  const [x, y] = less(placeOf(scene, pose, about), placeOf(scene, pose, cam.about));
  return Math.atan2(y, x);
}

/** Returns the position on a closed curve `at` so many of its points from the first one on. */
function on(points, at) {
  const count = points.length - 1;
  const first = Math.floor(at);
  const [one, next] = [first, first + 1].map((i) => points[((i % count) + count) % count]);
  return one.map((value, i) => value + (at - first) * (next[i] - value));
}

function less([x, y], [u, v]) {
  return [x - u, y - v];
}

/** A scene that starts in a given pose, as one to which it was dragged or driven. */

import { angleOf, ends, heading, marks, placeOf } from "../mechanism/placing.js";

const DIGITS = 9; // of angles and positions: a picture has no more

/**
 * Returns the document with the pose as its start, which its drivers then begin at, too.
 *
 * @param document of the scene
 * @param scene the same with its parameters set
 * @param pose of every body
 * @param before the pose in which it starts now
 */
export function startedIn(document, scene, pose, before) {
  const angles = Object.fromEntries(Object.entries(pose).map(([body, [, , angle]]) => [body, near(angle)]));
  const points = Object.fromEntries(references(scene).map((one) => [one, placeOf(scene, pose, one).map(near)]));
  const { points: _, ...kept } = document.start ?? {};
  const start = { ...kept, angles, ...(Object.keys(points).length ? { points } : {}) };
  if (!document.drivers) return { ...document, start };
  const drivers = Object.fromEntries(Object.entries(document.drivers).map(([name, driver]) => {
    const moved = driven(scene, pose, driver) - driven(scene, before, driver);
    return [name, { ...driver, position: near((scene.drivers[name].position ?? 0) + moved) }];
  }));
  return { ...document, drivers, start };
}

/** Returns a point of each body that slides, and of each that no joint holds: angles do not say where these are. */
function references(scene) {
  const joints = Object.values(scene.joints ?? {});
  const held = new Set(joints.flatMap((joint) => ends(joint).map((one) => one.split(".")[0])));
  const slides = joints.filter((joint) => marks(joint).axis).map((joint) => ends(joint)[1]);
  const free = Object.entries(scene.bodies).filter(([body, { points }]) => !held.has(body) && points);
  return [...slides.filter((one) => !one.startsWith("ground.")),
    ...free.map(([body, { points }]) => `${body}.${Object.keys(points)[0]}`)];
}

/** Returns where a driver stands in a pose, in rad or m, up to a constant. */
function driven(scene, pose, { joint: name, body }) {
  if (body) return pose[body][2];
  const joint = scene.joints[name];
  const [base, other] = ends(joint);
  if (!marks(joint).axis) return angleOf(pose, other) - angleOf(pose, base);
  const [from, to] = [base, other].map((one) => placeOf(scene, pose, one));
  const along = heading(pose, joint);
  return (to[0] - from[0]) * Math.cos(along) + (to[1] - from[1]) * Math.sin(along);
}

function near(number) {
  const rounded = Number(number.toPrecision(DIGITS));
  return Math.abs(rounded) < 1e-12 ? 0 : rounded;
}

/** A scene that starts in a given pose, as one to which it was dragged or driven. */

import { withDefaults } from "../mechanism/parameters.js";
import { angleOf, ends, heading, marks, placeOf } from "../mechanism/placing.js";

const DIGITS = 9; // of angles and positions: a picture has no more
const STARTS = /^\/(start\/(angles|points)|drivers\/[^/]+\/position$)/;

/**
 * Returns the document with the pose as its start, which its drivers then begin at, too, and parameters of these.
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
  if (!document.drivers) return withSameDefaults({ ...document, start });
  const drivers = Object.fromEntries(Object.entries(document.drivers).map(([name, driver]) => {
    const moved = driven(scene, pose, driver) - driven(scene, before, driver);
    return [name, { ...driver, position: near((scene.drivers[name].position ?? 0) + moved) }];
  }));
  return withSameDefaults({ ...document, drivers, start });
}

/** Returns the document with those defaults that put into its start what stands there; of parameters of it alone. */
function withSameDefaults(document) {
  const defaults = Object.entries(document.parameters ?? {}).map(([name, { default: own, targets }]) => {
    const alone = typeof own === "number" && targets.every(({ path }) => STARTS.test(path));
    const [value] = targets.map(({ path, factor = 1 }) => at(document, path) / factor).filter(Number.isFinite);
    return [name, alone && value !== undefined ? near(value) : own];
  });
  return withDefaults(document, Object.fromEntries(defaults));
}

/** Returns what stands at a place of the document; undefined: nothing does. */
function at(document, path) {
  return path.split("/").slice(1).reduce((node, key) => node?.[key], document);
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

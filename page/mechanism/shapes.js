/**
 * A mechanism at a pose as a list of shapes, for a canvas or an SVG file alike.
 *
 * A shape is `{kind, points, …}` with kind `line`, `polygon`, `disc` or `text`. A point is
 * `[x, y, right, down]`: a position in the world in m, and pixels from there. Colours are names of the
 * palette, widths and radii pixels.
 */

import { bounds } from "./bounds.js";
import { curves } from "./curves.js";
import { guides } from "./guides.js";
import { GROUND, ends, heading, marks, placeOf, play, world } from "./placing.js";

const BLOCK = [15, 9]; // half a slider's length and height, px
const FLAT = 1e-9; // twice the area of a triangle that is a line, squares of the largest distance
const BESIDE = 0.03; // a centre of mass closer to a body's only point is in it, extents

/** Returns the shapes of a scene at a pose, from the back to the front. */
export function shapes(scene, pose, { labels = false } = {}) {
  const box = bounds(scene, [pose]);
  const size = Math.max(box[2] - box[0], box[3] - box[1]);
  const drawn = curves(scene, pose);
  return [
    ...rails(scene, pose, size),
    ...drawn.filter(({ filled }) => filled).map(({ points }) =>
      ({ kind: "polygon", points, fill: "ground", stroke: "edge", width: 1.2 })),
    ...supports(scene, pose),
    ...guides(scene, pose, size).flatMap(({ slider, walls }) => [
      { kind: "polygon", points: slider, fill: "ground", stroke: "edge", width: 1.2 },
      ...walls.map((points) => ({ kind: "line", points, colour: "play", width: 3 })),
    ]),
    ...Object.keys(scene.bodies).flatMap((name, i) => body(scene, pose, name, i, size)),
    ...springs(scene, pose),
    ...drawn.filter(({ filled }) => !filled).map(({ points }) =>
      ({ kind: "line", points, colour: "edge", width: 2 })),
    ...joints(scene, pose),
    ...(labels ? names(scene, pose) : []),
  ];
}

const apart = (a, b) => Math.hypot(b[0] - a[0], b[1] - a[1]);

/**
 * Returns corners of the convex hull, counter-clockwise (Andrew's monotone chain); of points in a
 * line, to rounding, the ends.
 */
export function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const turn = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  const half = (list) => {
    const chain = [];
    for (const point of list) {
      while (chain.length > 1 && turn(chain.at(-2), chain.at(-1), point) <= 0) chain.pop();
      chain.push(point);
    }
    return chain.slice(0, -1);
  };
  if (sorted.length < 3) return sorted;
  const far = (from) => sorted.reduce((a, b) => (apart(from, b) > apart(from, a) ? b : a));
  const end = far(sorted[0]);
  const start = far(end);
  const flat = FLAT * apart(start, end) ** 2;
  if (sorted.every((point) => Math.abs(turn(start, end, point)) <= flat)) return [start, end];
  return [...half(sorted), ...half(sorted.reverse())];
}

function rails(scene, pose, size) {
  return sliding(scene, pose).map(({ at, along }) => ({
    kind: "line",
    points: [-0.16, 0.16].map((share) => [
      at[0] + share * size * along[0], at[1] + share * size * along[1],
    ]),
    colour: "faint",
    width: 1.2,
    dash: [8, 3, 2, 3],
  }));
}

/** Joints that slide, each with its position and the direction of its axis in the world. */
function sliding(scene, pose) {
  return Object.values(scene.joints)
    .filter((joint) => joint[marks(joint).axis])
    .map((joint) => {
      const [, slider] = ends(joint);
      const angle = heading(pose, joint);
      const along = [Math.cos(angle), Math.sin(angle)];
      return { at: placeOf(scene, pose, slider), along, body: slider.split(".")[0] };
    });
}

function supports(scene, pose) {
  const found = [];
  for (const joint of Object.values(scene.joints)) {
    const [first, second] = ends(joint);
    const grounded = [first, second].find((end) => end.startsWith(`${GROUND}.`));
    if (!marks(joint).supported || !grounded || play(joint) > 0.05) continue;
    const [x, y] = placeOf(scene, pose, grounded);
    const at = (points) => points.map(([right, down]) => [x, y, right, down]);
    found.push({
      kind: "polygon", points: at([[0, 0], [-10, 14], [10, 14]]),
      fill: "ground", stroke: "edge", width: 1.2,
    });
    const strokes = [[[-15, 14], [15, 14]], ...[-11, -4, 3, 10].map((s) => [[s, 14], [s - 4, 19]])];
    for (const stroke of strokes) {
      found.push({ kind: "line", points: at(stroke), colour: "edge", width: 1.2 });
    }
  }
  return found;
}

function body(scene, pose, name, index, size) {
  const tint = `tint-${index % 6}`;
  const points = Object.values(scene.bodies[name].points ?? {}).map((at) => world(pose, name, at));
  const corners = hull(unique(points));
  const rail = sliding(scene, pose).find((one) => one.body === name);
  const [x, y] = corners[0] ?? pose[name];
  // a body of one point that does not slide reaches to its centre of mass
  const [right, up] = [pose[name][0] - x, pose[name][1] - y];
  if (corners.length === 1 && !rail && Math.hypot(right, up) >= BESIDE * size) {
    corners.push(pose[name].slice(0, 2));
  }
  if (corners.length > 2) {
    return [{
      kind: "polygon", points: corners, fill: tint, stroke: "edge", width: 1.4, round: 6,
    }];
  }
  if (corners.length === 2) {
    return [
      { kind: "line", points: corners, colour: "edge", width: 11, cap: "round" },
      { kind: "line", points: corners, colour: tint, width: 8.4, cap: "round" },
    ];
  }
  if (!rail) {
    const dot = [0, 1].map((i) => 8 * (i ? -Math.sin(pose[name][2]) : Math.cos(pose[name][2])));
    return [
      { kind: "disc", points: [[x, y]], radius: 12, fill: tint, stroke: "edge", width: 1.4 },
      { kind: "line", points: [[x, y], [x, y, ...dot]], colour: "edge", width: 1.4 },
    ];
  }
  const [c, s] = rail.along;
  const block = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) => {
    const [along, across] = [a * BLOCK[0], b * BLOCK[1]];
    return [x, y, c * along - s * across, -(s * along + c * across)];
  });
  return [{ kind: "polygon", points: block, fill: tint, stroke: "edge", width: 1.4 }];
}

function springs(scene, pose) {
  return Object.values(scene.forces ?? {}).flatMap((force) => {
    if (!force.first || !force.second) return [];
    const [a, b] = [force.first, force.second].map((end) => placeOf(scene, pose, end));
    if (!force.stiffness) {
      return [{ kind: "line", points: [a, b], colour: "faint", width: 1.2, dash: [3, 3] }];
    }
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
    const [nx, ny] = [(a[1] - b[1]) / length, (b[0] - a[0]) / length];
    const turns = 8;
    const coils = Array.from({ length: turns * 2 + 1 }, (_, i) => {
      const share = 0.15 + (0.7 * i) / (turns * 2);
      const off = i === 0 || i === turns * 2 ? 0 : i % 2 ? 6 : -6;
      const position = [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])];
      return [...position, off * nx, -off * ny];
    });
    return [{ kind: "line", points: [a, ...coils, b], colour: "edge", width: 1.3 }];
  });
}

function joints(scene, pose) {
  const drivers = Object.values(scene.drivers ?? {});
  const [driven, moved] = ["joint", "body"].map((of) => new Set(drivers.map((driver) => driver[of])));
  const isDriven = (name, joint) =>
    driven.has(name) || (marks(joint).turns && moved.has(ends(joint)[1].split(".")[0]));
  const around = ([, joint]) => (play(joint) > 0 ? 0 : 1); // rings lie under others at their position
  const ordered = Object.entries(scene.joints).sort((a, b) => around(a) - around(b));
  return ordered.flatMap(([name, joint]) => {
    if (!marks(joint).sign) return [];
    const at = placeOf(scene, pose, ends(joint)[1]);
    if (marks(joint).sign === "weld") {
      const square = [[-4, -4], [4, -4], [4, 4], [-4, 4]].map((offset) => [...at, ...offset]);
      return [{ kind: "polygon", points: square, fill: "edge", stroke: "edge", width: 1 }];
    }
    const disc = { kind: "disc", points: [at], stroke: "edge", fill: "paper", width: 1.4 };
    if (play(joint) > 0) return [{ ...disc, radius: 6.5, stroke: "play", width: 3 }];
    return [{ ...disc, radius: 4.5, fill: isDriven(name, joint) ? "edge" : "paper" }];
  });
}

function names(scene, pose) {
  const written = [];
  const ofJoints = Object.entries(scene.joints).filter(([, joint]) => marks(joint).sign).map(([text, joint]) => {
    const at = placeOf(scene, pose, ends(joint)[1]);
    const near = written.filter(([x, y]) => Math.hypot(x - at[0], y - at[1]) < 1e-6).length;
    written.push(at);
    return { kind: "text", points: [[...at, 10, -9 - 13 * near]], text, colour: "ink", bold: true };
  });
  const ofBodies = Object.keys(scene.bodies).map((text) => { // below, where no joint's name is
    const [x, y] = pose[text];
    return { kind: "text", points: [[x, y, 10, 20]], text, colour: "quiet", italic: true };
  });
  return [...ofBodies, ...ofJoints];
}

function unique(points) {
  return points.filter((p, i) =>
    points.findIndex((o) => Math.hypot(o[0] - p[0], o[1] - p[1]) < 1e-12) === i);
}

/**
 * Poses that satisfy the joints, for pictures before anything is computed.
 *
 * Levenberg and Marquardt's iteration on the constraints of joints, gears and drivers, as in
 * Nikravesh, Computer-Aided Analysis of Mechanical Systems, ch. 4. Joints with play are ideal here,
 * with the journal where the scene starts it. Results are for the eye; those of a job come from
 * the service.
 */

import { GROUND, ends, reference } from "./placing.js";
import { solve } from "./linear.js";
import { profileAt, slopeAt } from "./profile.js";

const MOST_STEPS = 60;
const CLOSED = 1e-7; // of the size of the mechanism

/** Returns the pose in which the iteration begins: the scene's angles, bodies joint by joint. */
export function firstPose(scene) {
  const angles = scene.start?.angles ?? {};
  const pose = {};
  const turned = ([x, y], a) => [
    x * Math.cos(a) - y * Math.sin(a), x * Math.sin(a) + y * Math.cos(a),
  ];
  const joints = Object.values(scene.joints).map((joint) =>
    ends(joint).map((end) => reference(scene, end)));
  for (let found = true; found; ) {
    found = false;
    for (const [first, second] of [...joints, ...joints.map(([a, b]) => [b, a])]) {
      const known = first.body === GROUND || first.body in pose;
      if (!known || second.body === GROUND || second.body in pose) continue;
      const [px, py, a] = first.body === GROUND ? [0, 0, 0] : pose[first.body];
      const from = turned(first.at, a);
      const angle = angles[second.body] ?? 0;
      const own = turned(second.at, angle);
      pose[second.body] = [px + from[0] - own[0], py + from[1] - own[1], angle];
      found = true;
    }
  }
  for (const body of Object.keys(scene.bodies)) pose[body] ??= [0, 0, angles[body] ?? 0];
  for (const [end, [x, y]] of Object.entries(scene.start?.points ?? {})) {
    const { body, at } = reference(scene, end);
    const own = turned(at, pose[body][2]);
    pose[body] = [x - own[0], y - own[1], pose[body][2]];
  }
  return pose;
}

/**
 * Returns the pose near another one that satisfies the joints.
 *
 * @param scene the scene document, its parameters set
 * @param near pose to begin with
 * @param drive seconds by which the drivers have gone on; `null` leaves them free
 * @param pulls places `{body, at, to}` that points of bodies are pulled to
 * @returns `{pose, misfit}`, the misfit in m
 */
export function assembled(scene, near, drive = 0, pulls = []) {
  const bodies = Object.keys(scene.bodies);
  const size = sizeOf(scene);
  const q = bodies.flatMap((body) => {
    const [x, y, angle] = near[body];
    return [x / size, y / size, angle];
  });
  const system = new Constraints(scene, bodies, size, drive, pulls);
  let damping = 1e-6;
  let rows = system.rows(q);
  for (let step = 0; step < MOST_STEPS && misfit(rows) > CLOSED; step++) {
    const change = solve(rows, q.length, damping);
    const next = q.map((value, i) => value + change[i]);
    const tried = system.rows(next);
    if (misfit(tried) < misfit(rows)) {
      next.forEach((value, i) => (q[i] = value));
      const gain = misfit(rows) - misfit(tried);
      rows = tried;
      damping = Math.max(damping / 10, 1e-12);
      if (pulls.length && gain < 1e-6) break;
    } else {
      damping *= 10;
      if (damping > 1e6) break;
    }
  }
  const pose = {};
  bodies.forEach((body, i) => (pose[body] = [q[3 * i] * size, q[3 * i + 1] * size, q[3 * i + 2]]));
  return { pose, misfit: misfit(rows) * size };
}

function misfit(rows) {
  return Math.sqrt(rows.reduce((sum, { value }) => sum + value * value, 0));
}

function sizeOf(scene) {
  const places = [scene.ground ?? {}, ...Object.values(scene.bodies)].flatMap(({ points = {} }) =>
    Object.values(points).map(([x, y]) => Math.hypot(x, y)));
  return Math.max(...places, 1e-9);
}

/** The equations of joints, gears, drivers and pulls at coordinates q, lengths in sizes. */
class Constraints {
  constructor(scene, bodies, size, drive, pulls) {
    Object.assign(this, { scene, size, drive, pulls });
    this.index = new Map(bodies.map((body, i) => [body, 3 * i]));
  }

  /** Returns rows `{value, slopes}` with the slopes by coordinate. */
  rows(q) {
    this.q = q;
    const { scene } = this;
    const rows = [];
    for (const [name, joint] of Object.entries(scene.joints)) rows.push(...this.joint(name, joint));
    for (const gear of Object.values(scene.gears ?? {})) rows.push(this.gear(gear));
    if (this.drive !== null) {
      for (const driver of Object.values(scene.drivers ?? {})) rows.push(this.driver(driver));
    }
    for (const pull of this.pulls) rows.push(...this.pull(pull));
    return rows.filter(Boolean);
  }

  point(body, [x, y]) {
    const at = this.index.get(body);
    if (at === undefined) return { at, place: [x / this.size, y / this.size], turn: [0, 0] };
    const [px, py, angle] = this.q.slice(at, at + 3);
    const c = Math.cos(angle);
    const s = Math.sin(angle);
    const own = [(c * x - s * y) / this.size, (s * x + c * y) / this.size];
    return { at, place: [px + own[0], py + own[1]], turn: [-own[1], own[0]] };
  }

  angle(body) {
    const at = this.index.get(body);
    return at === undefined ? 0 : this.q[at + 2];
  }

  joint(name, joint) {
    const [first, second] = ends(joint).map((end) => reference(this.scene, end));
    const a = this.point(first.body, first.at);
    const b = this.point(second.body, second.at);
    if (joint.type === "revolute" || joint.type === "fixed") {
      const off = joint.clearance && this.scene.start?.joints?.[name]?.eccentricity;
      const rows = this.together(a, b, off ?? [0, 0]);
      if (joint.type === "fixed") rows.push(this.angles(first.body, second.body, joint.angle ?? 0));
      return rows;
    }
    if (joint.profile) return [this.cam(joint, first, second, a, b)];
    const across = [-joint.axis[1], joint.axis[0]];
    const rows = [this.along(first.body, a, b, across, 0)];
    if (joint.type === "prismatic") {
      rows.push(this.angles(first.body, second.body, joint.angle ?? 0));
    }
    return rows;
  }

  together(a, b, [ex, ey]) {
    return [0, 1].map((axis) => {
      const slopes = new Map();
      for (const [point, sign] of [[b, 1], [a, -1]]) {
        if (point.at === undefined) continue;
        add(slopes, point.at + axis, sign);
        add(slopes, point.at + 2, sign * point.turn[axis]);
      }
      return { value: b.place[axis] - a.place[axis] - [ex, ey][axis] / this.size, slopes };
    });
  }

  /** Distance of b from a along a direction that is fixed in a body, less `wanted`. */
  along(body, a, b, direction, wanted) {
    const angle = this.angle(body);
    const length = Math.hypot(...direction);
    const [x, y] = direction.map((one) => one / length);
    const d = [
      Math.cos(angle) * x - Math.sin(angle) * y, Math.sin(angle) * x + Math.cos(angle) * y,
    ];
    const apart = [b.place[0] - a.place[0], b.place[1] - a.place[1]];
    const slopes = new Map();
    for (const [point, sign] of [[b, 1], [a, -1]]) {
      if (point.at === undefined) continue;
      add(slopes, point.at, sign * d[0]);
      add(slopes, point.at + 1, sign * d[1]);
      add(slopes, point.at + 2, sign * (d[0] * point.turn[0] + d[1] * point.turn[1]));
    }
    if (a.at !== undefined) add(slopes, a.at + 2, -d[1] * apart[0] + d[0] * apart[1]);
    return { value: d[0] * apart[0] + d[1] * apart[1] - wanted / this.size, slopes };
  }

  angles(first, second, wanted, ratio = 1) {
    const slopes = new Map();
    for (const [body, sign] of [[second, 1], [first, -ratio]]) {
      if (this.index.has(body)) add(slopes, this.index.get(body) + 2, sign);
    }
    return { value: this.angle(second) - ratio * this.angle(first) - wanted, slopes };
  }

  /** A follower on its cam: a flat face as far away as the profile says, or a roller's centre. */
  cam(joint, first, second, a, b) {
    const apart = [b.place[0] - a.place[0], b.place[1] - a.place[1]];
    const reach = Math.hypot(...apart);
    const flat = joint.type === "flat-follower";
    const towards = flat
      ? this.angle(second.body) + Math.atan2(joint.normal[1], joint.normal[0])
      : Math.atan2(apart[1], apart[0]);
    const angle = towards - this.angle(first.body);
    const wanted = profileAt(joint.profile, angle) / this.size;
    const slope = slopeAt(joint.profile, angle) / this.size;
    const d = [Math.cos(towards), Math.sin(towards)];
    const across = [-d[1], d[0]];
    const turning = flat ? 0 : slope / reach; // of the direction, as the roller goes across
    const slopes = new Map();
    for (const [point, sign] of [[b, 1], [a, -1]]) {
      if (point.at === undefined) continue;
      const gain = [0, 1].map((axis) => sign * (d[axis] - turning * across[axis]));
      add(slopes, point.at, gain[0]);
      add(slopes, point.at + 1, gain[1]);
      add(slopes, point.at + 2, gain[0] * point.turn[0] + gain[1] * point.turn[1]);
    }
    if (a.at !== undefined) add(slopes, a.at + 2, slope);
    if (flat && b.at !== undefined) {
      add(slopes, b.at + 2, across[0] * apart[0] + across[1] * apart[1] - slope);
    }
    return { value: d[0] * apart[0] + d[1] * apart[1] - wanted, slopes };
  }

  gear({ first, second, ratio, offset = 0 }) {
    const joints = [second, first].map((name) => this.scene.joints[name]);
    if (joints.some((joint) => joint?.type !== "revolute")) return null;
    const slopes = new Map();
    let value = -offset;
    joints.forEach((joint, which) => {
      const [bearing, journal] = ends(joint).map((end) => reference(this.scene, end).body);
      const factor = which ? -ratio : 1;
      for (const [body, sign] of [[journal, factor], [bearing, -factor]]) {
        value += sign * this.angle(body);
        if (this.index.has(body)) add(slopes, this.index.get(body) + 2, sign);
      }
    });
    return { value, slopes };
  }

  driver(driver) {
    const wanted = (driver.position ?? 0) + (driver.speed ?? 0) * this.drive;
    if (driver.body) return this.angles(GROUND, driver.body, wanted);
    const joint = this.scene.joints[driver.joint];
    if (!joint) return null;
    const [first, second] = ends(joint).map((end) => reference(this.scene, end));
    if (joint.type === "revolute") return this.angles(first.body, second.body, wanted);
    if (joint.type !== "prismatic") return null;
    const [a, b] = [first, second].map(({ body, at }) => this.point(body, at));
    return this.along(first.body, a, b, joint.axis, wanted);
  }

  pull({ body, at, to }) {
    const hand = { at: undefined, place: to.map((one) => one / this.size) };
    return this.together(hand, this.point(body, at), [0, 0]).map(({ value, slopes }) => ({
      value: 0.01 * value,
      slopes: new Map([...slopes].map(([i, slope]) => [i, 0.01 * slope])),
    }));
  }
}

function add(slopes, index, value) {
  slopes.set(index, (slopes.get(index) ?? 0) + value);
}

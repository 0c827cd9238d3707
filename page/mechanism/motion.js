/** The motion of a job: poses and contacts at any time, from the history that it has stored. */

import { play } from "./placing.js";
import { getArrays } from "../requests/arrays.js";

const CHUNK = 2048; // samples that are fetched at once
const KEPT = 24; // chunks
const QUANTITIES = {
  revolute: ["eccentricity_x", "eccentricity_y", "normal_force"],
  prismatic: ["penetration", "normal_force"],
  "pin-in-slot": ["penetration", "normal_force"],
  "flat-follower": ["penetration", "normal_force"],
  "roller-follower": ["penetration", "normal_force"],
};
const PARTS = {
  revolute: [""],
  prismatic: [".corner_1", ".corner_2", ".corner_3", ".corner_4"],
  "pin-in-slot": [".wall_1", ".wall_2"],
  "flat-follower": [""],
  "roller-follower": [""],
};

/** The channels that the pictures of a scene are made of. */
function needed(scene) {
  const bodies = Object.keys(scene.bodies).flatMap((body) =>
    ["x", "y", "theta"].map((coordinate) => `${body}.${coordinate}`));
  return [...bodies, ...contactPairs(scene).flatMap(({ pair, quantities }) =>
    quantities.map((one) => `${pair}.${one}`))];
}

/** Names of the joints whose play can be shown magnified. */
export function magnifiable(scene) {
  return Object.entries(scene.joints)
    .filter(([, joint]) => joint.type in PARTS && play(joint) > 0)
    .map(([name]) => name);
}

/** Names of the places where the bodies of a joint with play touch: `A`, or `guide.corner_1` …. */
export function pairs(scene, name) {
  return PARTS[scene.joints[name].type].map((part) => `${name}${part}`);
}

function contactPairs(scene) {
  return magnifiable(scene).flatMap((name) => pairs(scene, name).map((pair) =>
    ({ pair, quantities: QUANTITIES[scene.joints[name].type] })));
}

export class Motion {
  /**
   * @param job the job as the service shows it, of kind `simulate`
   * @param scene its scene document, its parameters set
   * @param onNew called when something that was missing has come
   */
  constructor(job, scene, onNew, signal) {
    Object.assign(this, { job, scene, onNew, signal });
    this.step = job.job.output_step;
    const stored = new Set(job.job.channels);
    this.names = needed(scene).filter((name) => stored.has(name));
    this.missing = Object.keys(scene.bodies).filter((body) => !stored.has(`${body}.x`)
      || !stored.has(`${body}.y`) || !stored.has(`${body}.theta`));
    this.chunks = new Map();
  }

  /** Returns the chunk that holds a time, or null while it is fetched. */
  chunk(time) {
    const index = indexOf(time, this.step);
    const found = this.chunks.get(index);
    if (!found && !this.error) this.fetch(index);
    return found?.columns ?? null;
  }

  /** Waits until the motion at a time is there. */
  async ready(time) {
    if (this.chunk(time)) return;
    await this.chunks.get(indexOf(time, this.step))?.coming;
    if (this.error) throw this.error;
  }

  /** Fetches a chunk, unless that is done. */
  fetch(index) {
    if (this.chunks.has(index)) return;
    const entry = { columns: null, complete: false };
    this.chunks.set(index, entry);
    entry.coming = this.fill(entry, index);
  }

  async fill(entry, index) {
    if (this.chunks.size > KEPT) this.chunks.delete(this.chunks.keys().next().value);
    const start = Math.max(0, (index * CHUNK - 0.5) * this.step);
    const stop = ((index + 1) * CHUNK + 1.5) * this.step;
    try {
      const query = { channels: this.names.join(","), start, stop };
      const { columns, complete } = await getArrays(this.job.links.history, query, this.signal);
      if (columns.time.length < 1) this.chunks.delete(index);
      else Object.assign(entry, { columns, complete });
      this.onNew();
    } catch (error) {
      this.chunks.delete(index);
      if (error.name === "AbortError") return;
      this.error = error;
      this.onNew();
    }
  }

  /** Forgets what was incomplete: the job has gone on. */
  refresh() {
    this.error = null;
    for (const [index, { columns, complete }] of this.chunks) {
      if (columns && !complete) this.chunks.delete(index);
    }
  }

  /** Returns `{pose, contacts}` at a time, or null while they are fetched. */
  at(time) {
    const columns = this.chunk(time);
    if (!columns) return null;
    const { index, share } = between(columns.time, time);
    const value = (name) => {
      const values = columns[name];
      const next = values[Math.min(index + 1, values.length - 1)];
      return values[index] + share * (next - values[index]);
    };
    const pose = {};
    for (const body of Object.keys(this.scene.bodies)) {
      pose[body] = [value(`${body}.x`), value(`${body}.y`), value(`${body}.theta`)];
    }
    const contacts = {};
    for (const { pair, quantities } of contactPairs(this.scene)) {
      if (!columns[`${pair}.${quantities[0]}`]) continue;
      contacts[pair] = Object.fromEntries(quantities.map((quantity) =>
        [quantity, columns[`${pair}.${quantity}`] ? value(`${pair}.${quantity}`) : NaN]));
    }
    return { pose, contacts };
  }

  /** Returns poses spread over a chunk, to see how far the mechanism reaches. */
  reach(time) {
    const columns = this.chunk(time);
    if (!columns) return [];
    const stride = Math.max(1, Math.floor(columns.time.length / 60));
    const poses = [];
    for (let i = 0; i < columns.time.length; i += stride) {
      poses.push(Object.fromEntries(Object.keys(this.scene.bodies).map((body) =>
        [body, ["x", "y", "theta"].map((one) => columns[`${body}.${one}`][i])])));
    }
    return poses;
  }

  /** Returns the journal's path of a joint up to a time: `[[x, y], …]`, at most `count` samples. */
  trail(joint, time, count) {
    const columns = this.chunk(time);
    const x = columns?.[`${joint}.eccentricity_x`];
    const y = columns?.[`${joint}.eccentricity_y`];
    if (!x || !y) return [];
    const { index } = between(columns.time, time);
    const path = [];
    for (let i = Math.max(0, index - count); i <= index; i++) path.push([x[i], y[i]]);
    return path;
  }
}

function indexOf(time, step) {
  return Math.max(0, Math.floor(time / step / CHUNK + 1e-9));
}

/** Returns the index of the last time that is not later, and the share of the way to the next. */
function between(times, time) {
  let [low, high] = [0, times.length - 1];
  if (time >= times[high]) return { index: high, share: 0 };
  if (time <= times[0]) return { index: 0, share: 0 };
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return { index: low, share: (time - times[low]) / (times[high] - times[low]) };
}

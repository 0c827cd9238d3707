/** The motion of a job: poses and contacts at any time, from the history that it has stored. */

import { marks, play } from "./placing.js";
import { turn } from "./turn.js";
import { getArrays } from "../requests/arrays.js";
import { mayPass, pause } from "../requests/service.js";

const CHUNK = [256, 2048]; // samples that are fetched at once, at least and at most
const KEPT = 49152; // samples
const COME_BACK = 2000; // ms after which what did not come is asked for again
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
    .filter(([name, joint]) => marks(joint).picture && play(joint) > 0
      && (!marks(joint).has_curves || scene.curves.some((curve) => curve.joint === name)))
    .map(([name]) => name);
}

/** Names of the contact pairs at which the bodies of a joint with play touch: `A`, or `guide.corner_1` …. */
export function pairs(scene, name) {
  return Object.keys(marks(scene.joints[name]).parts).map((part) => (part ? `${name}.${part}` : name));
}

function quantities(joint) {
  const position = marks(joint).is_journal ? ["eccentricity_x", "eccentricity_y"] : ["penetration"];
  return [...position, "normal_force"];
}

function contactPairs(scene) {
  return magnifiable(scene).flatMap((name) => pairs(scene, name).map((pair) =>
    ({ pair, quantities: quantities(scene.joints[name]) })));
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
    // a turn: the first shows how far the mechanism reaches, and comes soon
    const wanted = Math.ceil((turn(scene) ?? 0) / this.step);
    this.count = Math.min(Math.max(wanted, CHUNK[0]), CHUNK[1]);
  }

  /** Returns the chunk that holds a time, as far as it has come; null: nothing of it has, or there is nothing. */
  chunk(time) {
    const index = this.indexOf(time);
    if (!this.error) this.fetch(index);
    return this.chunks.get(index)?.columns ?? null;
  }

  /** Returns the place of the chunk that holds a time; later than a run has come, that of its last one. */
  indexOf(time) {
    const { state, progress, job } = this.job;
    const reached = state === "succeeded" ? job.duration : progress.time;
    return Math.max(0, Math.floor(Math.min(time, reached) / this.step / this.count + 1e-9));
  }

  /** Fetches what follows soon, if it is computed. */
  prepare(time) {
    const next = this.indexOf(time + (this.count * this.step) / 2);
    if (next > this.indexOf(time)) this.fetch(next);
  }

  /** Waits until the motion at a time is there. */
  async ready(time) {
    this.chunk(time);
    await this.chunks.get(this.indexOf(time))?.coming;
    if (this.error) throw this.error;
  }

  /** Fetches a chunk, unless it is there, or on its way; an empty one is there, too. */
  fetch(index) {
    const known = this.chunks.get(index);
    if (known && (known.coming || !known.outdated)) return;
    const entry = known ?? { columns: null, complete: false };
    entry.outdated = false;
    this.chunks.set(index, entry);
    entry.coming = this.fill(entry, index);
  }

  async fill(entry, index) {
    if (this.chunks.size > KEPT / this.count) this.chunks.delete(this.chunks.keys().next().value);
    const start = Math.max(0, (index * this.count - 0.5) * this.step);
    const stop = ((index + 1) * this.count + 1.5) * this.step;
    try {
      const query = { channels: this.names.join(","), start, stop };
      const { columns, complete } = await getArrays(this.job.links.history, query, this.signal);
      Object.assign(entry, { columns: columns.time.length ? columns : null, complete, coming: null });
      if (complete) entry.outdated = false;
      this.onNew();
    } catch (error) {
      this.chunks.delete(index);
      if (error.name === "AbortError") return;
      this.error = error;
      this.onNew();
      if (mayPass(error)) this.comeBack().catch(() => {}); // until the view is left
    }
  }

  async comeBack() {
    await pause(COME_BACK, this.signal);
    this.error = null;
    this.onNew();
  }

  /** Has what is incomplete, or on its way, fetched once more when it is drawn: the job has gone on. */
  refresh() {
    this.error = null;
    for (const entry of this.chunks.values()) entry.outdated = !entry.complete;
  }

  /** Returns `{pose, contacts}` at a time, or null while they are fetched. */
  at(time) {
    const columns = this.chunk(time);
    if (!columns) return null;
    this.prepare(time);
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
    if (!columns) return [];
    const { index } = between(columns.time, time);
    const path = stretch(columns, joint, index - count + 1, index + 1);
    const before = this.chunks.get(this.indexOf(time) - 1)?.columns;
    if (path.length >= count || !before) return path;
    const last = before.time.findLastIndex((one) => one < columns.time[0]); // they overlap
    return [...stretch(before, joint, last + 1 - (count - path.length), last + 1), ...path];
  }
}

/** Returns the positions of a journal in its bearing from one sample to before another. */
function stretch(columns, joint, from, to) {
  const [x, y] = ["x", "y"].map((one) => columns[`${joint}.eccentricity_${one}`]);
  const path = [];
  for (let i = Math.max(0, from); x && y && i < to; i++) path.push([x[i], y[i]]);
  return path;
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

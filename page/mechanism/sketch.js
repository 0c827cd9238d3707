/** A mechanism on a canvas before anything is computed; its drivers can be let go on. */

import { bounds } from "./bounds.js";
import { paint, prepared } from "./canvas.js";
import { frame } from "./frame.js";
import { palette } from "./palette.js";
import { shapes } from "./shapes.js";
import { Newest } from "../requests/newest.js";
import { poses } from "../requests/poses.js";

const STEPS = 72; // poses of the drivers' motion
const SHOWN = 5000; // ms that it takes on the screen

/** Returns instants spread over the time that drivers take, the first and the last among them. */
export function instants(seconds, steps) {
  return Array.from({ length: steps + 1 }, (_, i) => (seconds * i) / steps);
}

/** Draws a scene at a pose in the frame of a box; returns that frame. */
export function drawn(canvas, scene, pose, box, { margin = 30, ...options } = {}) {
  const context = prepared(canvas);
  const view = frame(box, canvas.clientWidth, canvas.clientHeight, margin);
  paint(context, shapes(scene, pose, options), view, palette());
  canvas.dataset.pose = JSON.stringify(pose);
  return view;
}

export class Sketch {
  /**
   * @param canvas where scenes are drawn
   * @param options of the drawing; `onFound` is called with what the service answers of each scene
   */
  constructor(canvas, options, signal) {
    Object.assign(this, { canvas, options, signal, playing: false, share: 0, poses: [] });
    this.newest = new Newest((scene) => this.take(scene));
  }

  /** Shows a scene, its parameters set, instead of the one before. */
  show(scene) {
    this.newest.want(scene);
  }

  async take(scene) {
    const found = await poses(scene, [0], this.signal);
    this.scene = { ...scene, curves: found.curves };
    Object.assign(this, { found, poses: found.poses, box: bounds(this.scene, found.poses) });
    this.options.onFound?.(found);
    this.draw();
    if (this.playing) await this.sweep();
  }

  /** Draws it where it stands, or at a share of its motion. */
  draw(share = this.share) {
    if (!this.canvas.clientWidth || !this.poses.length) return;
    this.share = share;
    const last = this.poses.length - 1;
    const there = this.returns ? share : 1 - Math.abs(1 - 2 * share); // forth and back
    drawn(this.canvas, this.scene, this.poses[Math.round(there * last)], this.box, this.options);
  }

  /** Whether the motion goes on where it began. */
  get returns() {
    return this.found.repeats && !this.found.stopped;
  }

  /** Fetches the drivers' motion, once. */
  async sweep() {
    const { scene, found } = this;
    if (this.poses.length > 1 || !found?.drivers_time) return;
    const swept = await poses(scene, instants(found.drivers_time, STEPS), this.signal);
    if (scene !== this.scene || !swept.poses.length) return;
    Object.assign(this, { found: swept, poses: swept.poses, box: bounds(scene, swept.poses) });
  }

  async play() {
    if (this.playing) return;
    this.playing = true;
    const run = (this.run = {}); // frames of one that was stopped may still come
    let last = performance.now();
    const step = (now) => {
      if (this.run !== run || !this.canvas.isConnected) return;
      if (this.poses.length > 1) this.draw((this.share + Math.max(now - last, 0) / SHOWN) % 1);
      last = now;
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
    await this.sweep().catch(() => {}); // then it stands still
  }

  stop() {
    this.playing = false;
    this.run = null;
  }
}

/** Whether the reader asked for little motion. */
export function calm() {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}

/** A mechanism on a canvas before anything is computed; its drivers can be swept. */

import { assembled, firstPose } from "./assembling.js";
import { bounds } from "./bounds.js";
import { paint, prepared } from "./canvas.js";
import { frame } from "./frame.js";
import { palette } from "./palette.js";
import { shapes } from "./shapes.js";

const STEPS = 72; // poses of one turn
const SHOWN = 5000; // ms that one turn takes on the screen
const OPEN = 1e-3; // of its size by which a mechanism may be open

/** Returns a pose of a scene, or null where its joints do not close. */
export function startingPose(scene) {
  const { pose, misfit } = assembled(scene, firstPose(scene));
  const [left, low, right, high] = bounds(scene, [pose]);
  return misfit <= OPEN * Math.hypot(right - left, high - low) ? pose : null;
}

/** Seconds in which the slowest driver turns once; null where nothing turns. */
export function turn(scene) {
  const speeds = Object.values(scene.drivers ?? {}).map(({ speed }) => Math.abs(speed ?? 0));
  const slowest = Math.min(...speeds.filter((speed) => speed > 0));
  return Number.isFinite(slowest) ? (2 * Math.PI) / slowest : null;
}

export class Sketch {
  /**
   * @param canvas where it is drawn
   * @param scene the scene document, its parameters set
   */
  constructor(canvas, scene, options = {}) {
    Object.assign(this, { canvas, scene, options, playing: false, share: 0 });
    this.poses = [assembled(scene, firstPose(scene)).pose];
    this.box = bounds(scene, this.poses);
  }

  /** Draws it where it stands, or at a share of the turn. */
  draw(share = this.share) {
    if (!this.canvas.clientWidth) return;
    this.share = share;
    const pose = this.poses[Math.floor(share * this.poses.length) % this.poses.length];
    const context = prepared(this.canvas);
    const { clientWidth, clientHeight } = this.canvas;
    const view = frame(this.box, clientWidth, clientHeight, this.options.margin ?? 30);
    paint(context, shapes(this.scene, pose, this.options), view, palette());
  }

  /** Sweeps the drivers through one turn, once, so that it can be played. */
  sweep() {
    const seconds = turn(this.scene);
    if (this.poses.length > 1 || seconds === null) return;
    for (let step = 1; step < STEPS; step++) {
      const { pose } = assembled(this.scene, this.poses.at(-1), (seconds * step) / STEPS);
      this.poses.push(pose);
    }
    this.box = bounds(this.scene, this.poses);
  }

  play() {
    if (this.playing) return;
    this.sweep();
    this.playing = this.poses.length > 1;
    let last = performance.now();
    const step = (now) => {
      if (!this.playing || !this.canvas.isConnected) return;
      this.draw((this.share + Math.max(now - last, 0) / SHOWN) % 1);
      last = now;
      requestAnimationFrame(step);
    };
    if (this.playing) requestAnimationFrame(step);
  }

  stop() {
    this.playing = false;
  }
}

/** Whether the reader asked for little motion. */
export function calm() {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}

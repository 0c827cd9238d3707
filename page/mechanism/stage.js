/** The mechanism of a job, drawn as its clock runs. */

import { element } from "../interface/element.js";
import { bounds } from "./bounds.js";
import { paint, prepared } from "./canvas.js";
import { frame } from "./frame.js";
import { palette } from "./palette.js";
import { shapes } from "./shapes.js";

export class Stage {
  /** @param motions one, or several to be compared in one picture */
  constructor(motions, name) {
    Object.assign(this, { motions, name, labels: false, box: null, seen: new WeakSet() });
    this.canvas = element("canvas", { role: "img", "aria-label": `The mechanism ${name} in motion` });
    this.frames = 0;
  }

  /** Draws the mechanism at a time; returns its states, of each motion one or null. */
  draw(time) {
    if (!this.canvas.clientWidth) return this.motions.map((motion) => motion.at(time));
    this.reach(time);
    const context = prepared(this.canvas);
    const { clientWidth, clientHeight } = this.canvas;
    const states = this.paint(context, time, clientWidth, clientHeight);
    if (!this.box) {
      this.say(context, this.motions.find(({ error }) => error)?.error.message ?? "Loading the motion …");
    }
    if (states.some(Boolean)) this.frames += 1;
    this.canvas.dataset.frames = String(this.frames);
    return states;
  }

  /** Draws the mechanism into a picture of some width and height; returns its states. */
  paint(context, time, width, height) {
    const states = this.motions.map((motion) => motion.at(time));
    const view = this.box && this.view(width, height);
    const colours = palette();
    states.forEach((state, i) => {
      if (!state || !view) return;
      context.globalAlpha = 1;
      paint(context, this.shapes(state.pose, i), view, this.tinted(colours, i));
    });
    return states;
  }

  /** Waits until the motions at a time are there. */
  async ready(time) {
    for (const motion of this.motions) await motion.ready(time);
  }

  say(context, sentence) {
    context.font = "15px system-ui, sans-serif";
    context.textAlign = "center";
    context.fillStyle = palette().quiet;
    context.fillText(sentence, this.canvas.clientWidth / 2, this.canvas.clientHeight / 2);
  }

  shapes(pose, i) {
    return shapes(this.motions[i].scene, pose, { labels: this.labels && i === 0 });
  }

  /** Colours of one of several mechanisms: its bodies in the colour of its curves. */
  tinted(colours, i) {
    if (this.motions.length === 1) return colours;
    const own = colours[`curve-${i % 4}`];
    const pale = `color-mix(in srgb, ${own} 40%, ${colours.paper})`;
    const tints = [0, 1, 2, 3, 4, 5].map((one) => [`tint-${one}`, pale]);
    return { ...colours, ...Object.fromEntries(tints), edge: own };
  }

  view(width = this.canvas.clientWidth, height = this.canvas.clientHeight) {
    return frame(this.box, width, height, 42);
  }

  /** Lets the frame grow so that everything fits that was loaded around a time. */
  reach(time) {
    for (const motion of this.motions) {
      const columns = motion.chunk(time);
      if (!columns || this.seen.has(columns)) continue;
      this.seen.add(columns);
      const box = bounds(motion.scene, motion.reach(time));
      this.box = this.box
        ? [0, 1, 2, 3].map((i) => Math[i < 2 ? "min" : "max"](this.box[i], box[i]))
        : box;
    }
  }
}

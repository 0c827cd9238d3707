/** The joints with play of a job, magnified, as its clock runs. */

import { element, fill } from "../interface/element.js";
import { short, withUnit } from "../interface/numbers.js";
import { bearing } from "./bearing.js";
import { paint, prepared } from "./canvas.js";
import { frame } from "./frame.js";
import { magnifiable, pairs } from "./motion.js";
import { palette } from "./palette.js";
import { heading } from "./placing.js";
import { walls } from "./walls.js";

const TRAIL = 260; // samples
const MOST = 6;
const REACH = 140; // half the width of a picture, px
const NAMES = {
  revolute: (joint) => `Journal of joint ${joint} in its bearing`,
  prismatic: (joint) => `Slider of joint ${joint} in its guide`,
  "pin-in-slot": (joint) => `Pin of joint ${joint} in its slot`,
};

export class Insets {
  /** @param peaks extremes by channel, as the service gives them; may come later */
  constructor(motion) {
    this.motion = motion;
    this.peaks = {};
    const { joints } = motion.scene;
    this.joints = magnifiable(motion.scene).slice(0, MOST).map((name) => {
      const canvas = element("canvas", { role: "img", "aria-label": NAMES[joints[name].type](name) });
      const words = element("figcaption");
      return { name, canvas, words, figure: element("figure", {}, canvas, words) };
    });
    this.element = element("div", { class: "insets" }, this.joints.map(({ figure }) => figure));
  }

  draw(time, { pose, contacts }) {
    const { scene } = this.motion;
    const colours = palette();
    for (const { name, canvas, words } of this.joints) {
      const joint = scene.joints[name];
      const found = pairs(scene, name).map((pair) => contacts[pair]);
      if (!found.every(Boolean) || !canvas.clientWidth) continue;
      const limits = {
        strongest: this.peak(name, "normal_force") || 1,
        deepest: Math.max(this.peak(name, "penetration"), 1e-9),
      };
      const { shapes, exaggerated, deeper } = joint.type === "revolute"
        ? bearing(joint.clearance, found[0], this.motion.trail(name, time, TRAIL), limits)
        : walls(joint, heading(pose, joint), found, limits);
      const { clientWidth, clientHeight } = canvas;
      const scale = Math.min(clientWidth, clientHeight) / (2 * REACH);
      const context = prepared(canvas);
      context.translate(clientWidth / 2, clientHeight / 2);
      context.scale(scale, scale);
      paint(context, shapes, frame([0, 0, 0, 0], 0, 0), colours);
      const sum = found.reduce((total, { normal_force: one }) => total + one, 0);
      const force = sum > 0 ? withUnit(sum, "N", 3) : "no contact";
      const factors = `gap ×${short(exaggerated, 2)}, penetration ×${short(deeper, 2)}`;
      if (words.textContent === `${name} ${force}${factors}`) continue;
      fill(words, element("strong", {}, name), ` ${force}`, element("br"), factors);
    }
  }

  /** Returns the largest value of a quantity of a joint in the run; 0 while it is not known. */
  peak(name, quantity) {
    const found = pairs(this.motion.scene, name).map((pair) =>
      this.peaks[`${pair}.${quantity}`]?.maximum ?? 0);
    return Math.max(...found);
  }
}

/** The joints with play of a job, magnified, as its clock runs. */

import { element, fill } from "../interface/element.js";
import { short, withUnit } from "../interface/numbers.js";
import { bearing } from "./bearing.js";
import { paint, prepared } from "./canvas.js";
import { follower } from "./follower.js";
import { frame } from "./frame.js";
import { REACH, SHALLOWEST } from "./magnified.js";
import { magnifiable, pairs } from "./motion.js";
import { palette } from "./palette.js";
import { heading, marks } from "./placing.js";
import { walls } from "./walls.js";

const TRAIL = 260; // samples
const MOST = 6;

export class Insets {
  /** @param peaks extremes by channel, as the service gives them; may come later */
  constructor(motion) {
    this.motion = motion;
    this.peaks = {};
    const { joints } = motion.scene;
    this.joints = magnifiable(motion.scene).slice(0, MOST).map((name) => {
      const canvas = element("canvas", { role: "img", "aria-label": marks(joints[name]).caption.replace("{}", name) });
      const words = element("figcaption");
      return { name, canvas, words, figure: element("figure", {}, canvas, words) };
    });
    this.element = element("div", { class: "insets" }, this.joints.map(({ figure }) => figure));
  }

  draw(time, state) {
    const colours = palette();
    const places = new Map(this.joints.map((joint) => [joint.name, joint]));
    for (const { name, force, factors, shapes } of this.pictures(time, state)) {
      const { canvas, words } = places.get(name);
      const { clientWidth, clientHeight } = canvas;
      if (!clientWidth) continue;
      const scale = Math.min(clientWidth, clientHeight) / (2 * REACH);
      const context = prepared(canvas);
      context.translate(clientWidth / 2, clientHeight / 2);
      context.scale(scale, scale);
      paint(context, shapes, frame([0, 0, 0, 0], 0, 0), colours);
      if (words.textContent === `${name} ${force}${factors}`) continue;
      fill(words, element("strong", {}, name), ` ${force}`, element("br"), factors);
    }
  }

  /** Returns what is seen of the joints at a time: `{name, force, factors, shapes}` of each. */
  pictures(time, { pose, contacts }) {
    const { scene } = this.motion;
    return this.joints.flatMap(({ name }) => {
      const joint = scene.joints[name];
      const found = pairs(scene, name).map((pair) => contacts[pair]);
      if (!found.every(Boolean)) return [];
      const deepest = this.peak(name, "penetration");
      const limits = {
        strongest: this.peak(name, "normal_force") || 1,
        deepest: deepest > SHALLOWEST ? deepest : Infinity,
      };
      const { shapes, exaggerated, deeper } = this.magnified(name, time, pose, found, limits);
      const sum = found.reduce((total, { normal_force: one }) => total + one, 0);
      const force = sum > 0 ? withUnit(sum, "N", 3) : "no contact";
      const inside = deeper > 0 ? `, penetration ×${short(deeper, 2)}` : "";
      const factors = `gap ×${short(exaggerated, 2)}${inside}`;
      return [{ name, force, factors, shapes }];
    });
  }

  magnified(name, time, pose, contacts, limits) {
    const { scene } = this.motion;
    const joint = scene.joints[name];
    const { picture } = marks(joint);
    if (picture === "journal") {
      return bearing(joint.clearance, contacts[0], this.motion.trail(name, time, TRAIL), limits);
    }
    if (picture === "surface") return follower(scene, name, pose, contacts[0], limits);
    return walls(joint, heading(pose, joint), contacts, limits);
  }

  /** Returns the largest value of a quantity of a joint in the run; 0 while it is not known. */
  peak(name, quantity) {
    const found = pairs(this.motion.scene, name).map((pair) =>
      this.peaks[`${pair}.${quantity}`]?.maximum ?? 0);
    return Math.max(...found);
  }
}

/** The clearance joints of a job, magnified, as its clock runs. */

import { element, fill } from "../interface/element.js";
import { short, withUnit } from "../interface/numbers.js";
import { bearing } from "./bearing.js";
import { paint, prepared } from "./canvas.js";
import { frame } from "./frame.js";
import { journals } from "./motion.js";
import { palette } from "./palette.js";

const TRAIL = 260; // samples
const MOST = 6;

export class Insets {
  /** @param peaks extremes by channel, as the service gives them; may come later */
  constructor(motion) {
    this.motion = motion;
    this.peaks = {};
    this.joints = journals(motion.scene).slice(0, MOST).map((name) => {
      const canvas = element("canvas", { role: "img", "aria-label": `Journal of joint ${name} in its bearing` });
      const words = element("figcaption");
      return { name, canvas, words, figure: element("figure", {}, canvas, words) };
    });
    this.element = element("div", { class: "insets" }, this.joints.map(({ figure }) => figure));
  }

  draw(time, contacts) {
    const colours = palette();
    for (const { name, canvas, words } of this.joints) {
      const contact = contacts[name];
      if (!contact || !canvas.clientWidth) continue;
      const { clearance } = this.motion.scene.joints[name];
      const trail = this.motion.trail(name, time, TRAIL);
      const strongest = this.peaks[`${name}.normal_force`]?.maximum || 1;
      const deepest = Math.max(this.peaks[`${name}.penetration`]?.maximum || 0, 1e-9);
      const { shapes, exaggerated, deeper } =
        bearing(clearance, contact, trail, strongest, deepest);
      const { clientWidth, clientHeight } = canvas;
      const scale = Math.min(clientWidth, clientHeight) / 230;
      const context = prepared(canvas);
      context.translate(clientWidth / 2, clientHeight / 2);
      context.scale(scale, scale);
      paint(context, shapes, frame([0, 0, 0, 0], 0, 0), colours);
      const key = `${contact.normal_force.toPrecision(3)}`;
      if (words.dataset.key === key) continue;
      words.dataset.key = key;
      const force = contact.normal_force > 0
        ? withUnit(contact.normal_force, "N", 3)
        : "no contact";
      fill(words, element("strong", {}, name), ` ${force}`, element("br"),
        `gap ×${short(exaggerated, 2)}, penetration ×${short(deeper, 2)}`);
    }
  }
}

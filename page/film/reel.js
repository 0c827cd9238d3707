/** The pictures of a film: the mechanism at times of a stretch, its joints with play below it. */

import { arrangement, MARGIN } from "./arrangement.js";
import { paint, words } from "../mechanism/canvas.js";
import { frame } from "../mechanism/frame.js";
import { REACH } from "../mechanism/magnified.js";
import { palette } from "../mechanism/palette.js";
import { short, withUnit } from "../interface/numbers.js";

export class Reel {
  /**
   * @param stage the mechanism, as large as it is on the page
   * @param insets its magnified joints, or null
   * @param stretch see `stretch.js`
   * @param rate frames a second, about: their number is whole, and they last as long as the stretch
   * @param limits `most` pixels of a picture and its `widest` row; `even` lets sides be even
   */
  constructor(stage, insets, stretch, rate, { widest, most, even = false }) {
    Object.assign(this, { stage, insets, stretch });
    this.length = Math.max(1, Math.round(stretch.seconds * rate));
    this.seconds = stretch.seconds || 1 / rate;
    const { clientWidth: wide, clientHeight: high } = stage.canvas;
    this.arrangement = arrangement(wide, high, insets?.joints.length ?? 0);
    this.size = this.arrangement.size;
    const dots = window.devicePixelRatio || 1;
    this.scale = Math.min(dots, widest / wide, Math.sqrt(most / (this.size[0] * this.size[1])));
    const sides = this.size.map((side) => Math.floor(side * this.scale));
    [this.width, this.height] = even ? sides.map((side) => side - (side % 2)) : sides;
    const canvas = new OffscreenCanvas(this.width, this.height);
    this.context = canvas.getContext("2d", { willReadFrequently: true });
    this.canvas = canvas;
  }

  /** Simulated time of a picture. */
  time(index) {
    const { from, seconds, speed } = this.stretch;
    return from + (index / this.length) * seconds * speed;
  }

  /** Lets the stage see the whole stretch, so that its frame stands still in the film. */
  async load(tell) {
    for (let index = 0; index < this.length; index++) {
      await this.stage.ready(this.time(index));
      this.stage.reach(this.time(index));
      if (index % 10 === 0) tell(`Reading ${Math.round((100 * index) / this.length)} % …`);
    }
  }

  /** Draws a picture; its canvas is the same each time. */
  async draw(index) {
    const { context, stage, insets } = this;
    const time = this.time(index);
    await stage.ready(time);
    const [wide, high] = [this.size[0], this.stage.canvas.clientHeight];
    const colours = palette();
    context.setTransform(this.scale, 0, 0, this.scale, 0, 0);
    context.fillStyle = colours.paper;
    context.fillRect(0, 0, ...this.size);
    const [state] = stage.paint(context, time, wide, high);
    const { speed } = this.stretch;
    const slow = speed < 1 ? `, ${short(1 / speed, 3)} times slower` : "";
    words(context, `t = ${withUnit(time, "s", 4)}${slow}`, [MARGIN, MARGIN + 6], colours.ink);
    if (!state || !insets) return;
    const { side, place } = this.arrangement;
    insets.pictures(time, state).forEach(({ name, force, factors, shapes }, i) => {
      const { left, top, words: [first, second] } = place(i);
      context.save();
      context.beginPath();
      context.rect(left, top, side, side);
      context.clip();
      context.translate(left + side / 2, top + side / 2);
      context.scale(side / (2 * REACH), side / (2 * REACH));
      paint(context, shapes, frame([0, 0, 0, 0], 0, 0), colours);
      context.restore();
      words(context, `${name}, ${force}`, first, colours.ink);
      words(context, factors, second, colours.quiet);
    });
  }
}

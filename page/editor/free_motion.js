/** A mechanism before it is simulated: swept by its drivers, or dragged with the pointer. */

import { element } from "../interface/element.js";
import { assembled, firstPose } from "../mechanism/assembling.js";
import { bounds } from "../mechanism/bounds.js";
import { paint, prepared } from "../mechanism/canvas.js";
import { frame } from "../mechanism/frame.js";
import { palette } from "../mechanism/palette.js";
import { placeOf } from "../mechanism/placing.js";
import { shapes } from "../mechanism/shapes.js";
import { turn } from "../mechanism/sketch.js";

const STEPS = 240; // of the slider over one turn
const NEAR = 30; // px within which a point is taken hold of

export class FreeMotion {
  constructor() {
    this.canvas = element("canvas", { role: "img", "aria-label": "The mechanism as the text describes it" });
    this.slider = element("input", {
      type: "range", min: 0, max: STEPS, value: 0, id: "sweep",
      oninput: () => this.sweep(Number(this.slider.value)),
    });
    this.element = element("div", { class: "stacked" },
      element("div", { class: "stage" }, this.canvas),
      element("label", { for: "sweep", class: "small" }, "Drivers, through one turn"),
      this.slider,
      element("p", { class: "quiet small" }, "Drag a point to move what is free."));
    this.canvas.addEventListener("pointerdown", (event) => this.take(event));
  }

  /** Shows a scene; throws where it cannot be put together at all. Returns its misfit in m. */
  show(scene) {
    const { pose, misfit } = assembled(scene, firstPose(scene));
    Object.assign(this, { scene, pose, step: 0 });
    this.slider.value = "0";
    this.slider.disabled = turn(scene) === null;
    this.box = bounds(scene, [pose]);
    this.draw();
    return misfit;
  }

  sweep(step) {
    if (!this.scene) return;
    const seconds = turn(this.scene);
    const sign = Math.sign(step - this.step);
    while (this.step !== step) {
      this.step += sign;
      this.pose = assembled(this.scene, this.pose, (seconds * this.step) / STEPS).pose;
    }
    this.draw();
  }

  draw() {
    if (!this.scene || !this.canvas.clientWidth) return;
    const now = bounds(this.scene, [this.pose]);
    this.box = [0, 1, 2, 3].map((i) => Math[i < 2 ? "min" : "max"](this.box[i], now[i]));
    const context = prepared(this.canvas);
    paint(context, shapes(this.scene, this.pose, { labels: true }), this.view(), palette());
  }

  view() {
    return frame(this.box, this.canvas.clientWidth, this.canvas.clientHeight, 46);
  }

  /** Takes hold of the nearest point of a body; drivers let go meanwhile. */
  take(event) {
    if (!this.scene) return;
    const view = this.view();
    const { left, top } = this.canvas.getBoundingClientRect();
    const pointer = (from) => [from.clientX - left, from.clientY - top];
    const [px, py] = pointer(event);
    let best = null;
    for (const [body, { points = {} }] of Object.entries(this.scene.bodies)) {
      for (const [name, at] of Object.entries(points)) {
        const [x, y] = view.pixel(placeOf(this.scene, this.pose, `${body}.${name}`));
        const distance = Math.hypot(x - px, y - py);
        if (distance < (best?.distance ?? NEAR)) best = { body, at, distance };
      }
    }
    if (!best) return;
    event.preventDefault();
    const move = (next) => {
      const to = view.place(...pointer(next));
      const pulled = assembled(this.scene, this.pose, null, [{ ...best, to }]).pose;
      this.pose = assembled(this.scene, pulled, null).pose;
      this.draw();
    };
    addEventListener("pointermove", move);
    addEventListener("pointerup", () => removeEventListener("pointermove", move), { once: true });
  }
}

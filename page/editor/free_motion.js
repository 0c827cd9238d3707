/** A mechanism before it is run: moved by its drivers, or dragged with the pointer or by arrow keys. */

import { PulledByKeys } from "./pulled_by_keys.js";
import { button } from "../interface/button.js";
import { element, fill } from "../interface/element.js";
import { short, typed } from "../interface/numbers.js";
import { bounds } from "../mechanism/bounds.js";
import { palette } from "../mechanism/palette.js";
import { withParameters } from "../mechanism/parameters.js";
import { placeOf } from "../mechanism/placing.js";
import { drawn, instants } from "../mechanism/sketch.js";
import { Newest } from "../requests/newest.js";
import { dragged, poses } from "../requests/poses.js";

const STEPS = 120; // of the slider
const NEAR = 30; // px within which a point is taken hold of
const TOGETHER = 1; // px between points that are drawn as one
const RATE = 30; // poses a second while a point is dragged
const MARGIN = 46; // px around the mechanism

export class FreeMotion {
  /**
   * @param shown called with what the service answers of each scene that is shown
   * @param begun called with the scene, the pose in which it shall start, and the one in which it does
   */
  constructor(shown, begun, signal) {
    Object.assign(this, { shown, signal, scene: null });
    this.canvas = element("canvas", { role: "img", "aria-label": "The mechanism as the text describes it" });
    this.keys = new PulledByKeys(this.canvas, (...pull) => this.nudge(...pull), () => this.draw());
    this.slider = element("input", {
      type: "range", min: 0, max: STEPS, value: 0, id: "sweep", disabled: true,
      oninput: () => this.go(),
    });
    this.now = element("output", { for: "sweep", class: "small" });
    this.until = element("input", {
      id: "until", inputmode: "decimal", onchange: () => this.forget(),
    });
    this.here = button("Start here", () => begun(this.scene, this.pose, this.found.poses[0]), {
      disabled: true, title: "Write this pose into the text as its start",
    });
    this.said = element("p", { class: "quiet small", role: "status" });
    this.element = element("div", { class: "stacked" },
      element("div", { class: "stage" }, this.canvas),
      element("div", { class: "buttons small moving" },
        element("label", { for: "sweep" }, "Drivers at t ="), this.now,
        element("label", { for: "until" }, "of"), this.until, "s",
        button("To the start", () => this.begin()),
        this.here, this.keys.element),
      this.slider,
      this.said);
    this.scenes = new Newest((scene) => this.take(scene));
    this.pulls = new Newest((pull) => this.pull(pull), {
      rate: RATE, told: (busy) => this.canvas.setAttribute("aria-busy", String(busy)),
    });
    this.canvas.addEventListener("pointerdown", (event) => this.grasp(event));
  }

  /** Shows the scene of a document as soon as the service has put it together. */
  show(document) {
    this.here.disabled = true; // the pose that is drawn is not yet of this scene
    let scene;
    try {
      scene = withParameters(document);
    } catch {
      return this.missed(); // it is no scene yet, and its check says why
    }
    this.scenes.want(scene);
  }

  async take(scene) {
    const found = await poses(scene, [0], this.signal).catch((error) => {
      if (error.errors?.length) this.missed(); // the check tells what is wrong
      else if (error.name !== "AbortError") fill(this.said, `This is not drawn: ${error.message}`);
      throw error;
    });
    if (!found.poses.length) return;
    this.scene = { ...scene, curves: found.curves };
    this.keys.offer(this.scene);
    Object.assign(this, { found, box: bounds(this.scene, found.poses) });
    const { drivers_time: own } = found;
    this.slider.disabled = this.until.disabled = own === null;
    this.until.placeholder = own === null ? "" : String(Number(own.toPrecision(4)));
    this.forget();
    this.begin();
    this.shown(found);
  }

  /** Says that the picture is of an earlier text, where there is one. */
  missed() {
    this.here.disabled = true;
    if (this.scene) fill(this.said, "This text cannot be drawn: the picture is of an earlier one.");
  }

  /** Goes back to t = 0. */
  begin() {
    if (!this.scene) return;
    this.slider.value = "0";
    this.put(this.found.poses[0], 0);
  }

  /** Forgets the drivers' motion: it is asked for again when it is wanted. */
  forget() {
    this.swept = null;
    const hint = "Drag a point, or press arrow keys on the picture, to move what is free; the drivers let go"
      + " meanwhile.";
    fill(this.said, this.slider.disabled ? `Nothing is driven. ${hint}` : hint);
  }

  /** Shows the drivers where the slider stands; what failed is asked for again next time. */
  async go() {
    const swept = (this.swept ??= this.sweep());
    const { asked, answer } = await swept;
    if (!answer && this.swept === swept) this.swept = null;
    if (!answer || asked !== this.scene) return;
    const step = Math.min(Number(this.slider.value), answer.poses.length - 1);
    this.put(answer.poses[step], answer.times[step]);
  }

  /** Returns the drivers' motion; it is asked for once. */
  async sweep() {
    const asked = this.scene;
    try {
      const seconds = this.until.value.trim() ? typed(this.until.value) : this.found.drivers_time;
      if (!(seconds > 0)) throw new Error("Give a time in s.");
      const answer = await poses(asked, instants(seconds, STEPS), this.signal);
      if (answer.stopped) fill(this.said, answer.stopped.detail);
      return { asked, answer };
    } catch (error) {
      if (error.name !== "AbortError") fill(this.said, error.message);
      return { asked, answer: null };
    }
  }

  /** Shows a pose, at a time or, dragged, at none. */
  put(pose, time) {
    if (time !== null) this.pulls.drop();
    this.pose = pose;
    this.here.disabled = pose === this.found.poses[0];
    fill(this.now, time === null ? "–" : short(time, 4));
    this.draw();
  }

  draw() {
    if (!this.scene || !this.canvas.clientWidth) return;
    const now = bounds(this.scene, [this.pose]);
    this.box = [0, 1, 2, 3].map((i) => Math[i < 2 ? "min" : "max"](this.box[i], now[i]));
    this.view = drawn(this.canvas, this.scene, this.pose, this.box, { margin: MARGIN, labels: true });
    this.keys.mark((point) => this.pixelOf(point), palette().accent);
  }

  /** Returns where a point `body.name` is drawn, px. */
  pixelOf(point) {
    return this.view.pixel(placeOf(this.scene, this.pose, point));
  }

  /** Pulls a point by some pixels from where it is. */
  nudge(point, right, down) {
    if (!this.scene || !this.view) return;
    const [x, y] = this.pixelOf(point);
    this.pulls.want({ scene: this.scene, point, position: this.view.position(x + right, y + down) });
  }

  /** Takes hold of the nearest point of a body; drivers let go meanwhile. */
  grasp(event) {
    if (!this.scene) return;
    const { left, top } = this.canvas.getBoundingClientRect();
    const pointer = (from) => [from.clientX - left, from.clientY - top];
    const point = this.nearest(pointer(event));
    if (!point) return;
    event.preventDefault();
    const { scene, view } = this; // the picture may be scaled anew while the point is dragged
    const move = (next) => this.pulls.want({ scene, point, position: view.position(...pointer(next)) });
    const release = () => {
      removeEventListener("pointermove", move);
      for (const end of ["pointerup", "pointercancel"]) removeEventListener(end, release);
    };
    addEventListener("pointermove", move);
    for (const end of ["pointerup", "pointercancel"]) addEventListener(end, release);
  }

  /** Returns the reference of the point that is nearest to a pixel, or undefined if none is near;
   *  of points that a joint holds together, the one that the scene names first. */
  nearest([right, down]) {
    const found = Object.entries(this.scene.bodies).flatMap(([body, { points = {} }]) =>
      Object.keys(points).map((name) => {
        const [x, y] = this.pixelOf(`${body}.${name}`);
        return { point: `${body}.${name}`, distance: Math.hypot(x - right, y - down) };
      }));
    const least = Math.min(...found.map(({ distance }) => distance));
    if (least >= NEAR) return undefined;
    return found.find(({ distance }) => distance < least + TOGETHER).point;
  }

  async pull({ scene, point, position }) {
    const from = this.pose;
    const pose = await dragged(scene, from, point, position, this.signal);
    if (from === this.pose) this.put(pose, null); // unless another was put there meanwhile
  }
}

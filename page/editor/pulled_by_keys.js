/** A point of a mechanism that arrow keys move on its canvas, for those who use no pointer. */

import { element, fill } from "../interface/element.js";

const WAYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const STEP = 10; // px; with Shift one
const AROUND = 9; // px, radius of the ring around the point

export class PulledByKeys {
  /**
   * @param canvas takes the keys
   * @param pull called with the point `body.name` and by how many pixels, right and down, it is pulled
   * @param redraw draws the mechanism, so that another point is marked
   */
  constructor(canvas, pull, redraw) {
    Object.assign(this, { canvas, pull });
    this.choice = element("select", { id: "pulled", disabled: true, onchange: redraw });
    this.element = [element("label", { for: "pulled" }, "Arrow keys move"), this.choice];
    canvas.tabIndex = 0;
    canvas.addEventListener("keydown", (event) => this.press(event));
    for (const happened of ["focus", "blur"]) canvas.addEventListener(happened, redraw);
  }

  /** Offers the points of a scene; the one that was chosen stays chosen if the scene has it. */
  offer({ bodies }) {
    const { value: before } = this.choice;
    const points = Object.entries(bodies).flatMap(([body, { points: own = {} }]) =>
      Object.keys(own).map((name) => `${body}.${name}`));
    fill(this.choice, points.map((point) =>
      element("option", { value: point, selected: point === before }, point)));
    this.choice.disabled = points.length === 0;
  }

  /** Marks the point while keys move it; `pixelOf` returns where a point is drawn. */
  mark(pixelOf, colour) {
    if (document.activeElement !== this.canvas || !this.choice.value) return;
    const context = this.canvas.getContext("2d");
    context.beginPath();
    context.arc(...pixelOf(this.choice.value), AROUND, 0, 2 * Math.PI);
    context.lineWidth = 2;
    context.strokeStyle = colour;
    context.stroke();
  }

  press(event) {
    const way = WAYS[event.key];
    if (!way || !this.choice.value || event.altKey || event.ctrlKey || event.metaKey) return;
    event.preventDefault(); // the page stays where it is
    const step = event.shiftKey ? 1 : STEP;
    this.pull(this.choice.value, way[0] * step, way[1] * step);
  }
}

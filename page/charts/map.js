/** A chart as a map of tiles, which is moved with the pointer and scaled with the wheel. */

import { element } from "../interface/element.js";
import { prepared } from "../mechanism/canvas.js";
import { onNewColours, palette } from "../mechanism/palette.js";
import { axisFont, letters, writeUpward } from "../plots/axes.js";
import { Axis } from "./axis.js";

const TILE = 256; // points along each side of a tile
const CLOSEST = 40; // px of a point at most, or
const LARGER = 4; // times as large as in the whole chart
const STEP = 1.25; // of the scale, by one turn of the wheel or one key
const MOVE = 0.1; // of the picture, by one arrow key
const CLICK = 4; // px within which a drag is a click

export class ChartMap {
  /**
   * @param axes `{x, y}`, each `{parameter, unit, values}`
   * @param onpoint called with `[column, row]` of a point that was clicked
   * @param onhover called with the point under the pointer, or null
   */
  constructor({ x, y }, signal, onpoint, onhover) {
    Object.assign(this, { onpoint, onhover, tiles: null, from: null });
    this.x = new Axis(x);
    this.y = new Axis(y);
    this.size = [this.x.count, this.y.count];
    this.finest = Math.max(0, Math.ceil(Math.log2(Math.max(...this.size) / TILE)));
    this.canvas = element("canvas", {
      class: "canvas-plot", role: "img", tabindex: "0",
      "aria-label": `${y.parameter} over ${x.parameter}; arrows move, plus and minus scale`,
    });
    this.listen(signal);
    onNewColours(() => this.draw(), signal);
    new ResizeObserver(() => this.draw()).observe(this.canvas);
  }

  listen(signal) {
    const on = (name, take, options = {}) =>
      this.canvas.addEventListener(name, take, { signal, ...options });
    on("wheel", (event) => this.wheel(event), { passive: false });
    on("pointerdown", (event) => this.down(event));
    on("pointermove", (event) => this.move(event));
    on("pointerup", (event) => this.up(event));
    on("pointercancel", () => (this.from = this.begun = null)); // the browser took it: it scrolls
    on("pointerleave", () => this.onhover(null));
    on("dblclick", () => this.all());
    on("keydown", (event) => this.key(event));
  }

  /** Shows tiles of a quantity. */
  show(tiles) {
    this.tiles = tiles;
    this.draw();
  }

  /** Shows the whole chart. */
  all() {
    this.view = null;
    this.draw();
  }

  /** Draws with the next frame of the screen. */
  draw() {
    if (this.due) return;
    this.due = requestAnimationFrame(() => {
      this.due = null;
      if (this.tiles && this.canvas.clientWidth) this.paint();
    });
  }

  /** Returns the room for points, `[left, top, width, height]` in px. */
  room() {
    const size = letters();
    const [left, below] = [88 * size, 46 * size];
    const { clientWidth, clientHeight } = this.canvas;
    return [left, 10, clientWidth - left - 14, clientHeight - below - 10];
  }

  /** Gives the view: its lower left corner, in points, and px of a point along both axes. */
  fit() {
    const [, , width, height] = this.room();
    const whole = [width / this.size[0], height / this.size[1]];
    const view = this.view ?? { corner: [0, 0], scale: whole };
    view.scale = view.scale.map((one, k) => Math.min(Math.max(one, whole[k]), Math.max(CLOSEST, LARGER * whole[k])));
    view.corner = view.corner.map((one, k) =>
      Math.min(Math.max(one, 0), this.size[k] - [width, height][k] / view.scale[k]));
    this.view = view;
    return view;
  }

  paint() {
    const begun = performance.now();
    const [left, top, width, height] = this.room();
    const { corner, scale } = this.fit();
    const context = prepared(this.canvas);
    const colours = palette();
    context.save();
    context.beginPath();
    context.rect(left, top, width, height);
    context.clip();
    context.fillStyle = colours.ground;
    context.fillRect(left, top, width, height);
    context.imageSmoothingEnabled = false;
    const dots = Math.max(...scale) * (window.devicePixelRatio || 1);
    const level = Math.min(Math.max(this.finest + Math.ceil(Math.log2(dots)), 0), this.finest);
    for (const z of new Set([0, level])) this.paintLevel(context, z); // the whole below its parts
    this.tiles.send();
    context.restore();
    this.paintAxes(context, colours);
    this.canvas.dataset.frames = String(Number(this.canvas.dataset.frames ?? 0) + 1);
    this.canvas.dataset.frameTime = (performance.now() - begun).toFixed(2);
    this.canvas.dataset.waiting = String(this.tiles.waiting());
    this.canvas.dataset.view = JSON.stringify({ corner, scale });
  }

  /** Draws the tiles of a level; where one is not there yet, the part of a coarser one. */
  paintLevel(context, z) {
    const [left, top, width, height] = this.room();
    const { corner, scale } = this.view;
    const across = TILE * 2 ** (this.finest - z); // points along a tile
    const last = [width, height].map((room, k) =>
      Math.min(Math.floor((corner[k] + room / scale[k]) / across), Math.ceil(this.size[k] / across) - 1));
    for (let y = Math.floor(corner[1] / across); y <= last[1]; y++) {
      for (let x = Math.floor(corner[0] / across); x <= last[0]; x++) {
        const picture = this.tiles.get(z, x, y);
        if (!picture) continue;
        const right = left + (x * across - corner[0]) * scale[0];
        const down = top + height - ((y + 1) * across - corner[1]) * scale[1];
        context.drawImage(picture, right, down, across * scale[0], across * scale[1]);
      }
    }
  }

  paintAxes(context, colours) {
    const [left, top, width, height] = this.room();
    const { corner, scale } = this.view;
    const size = letters();
    context.font = axisFont();
    context.lineWidth = 1;
    context.strokeStyle = colours.faint;
    context.fillStyle = colours.quiet;
    context.strokeRect(left + 0.5, top + 0.5, width, height);
    const pixel = (k, index) => (index + 0.5 - corner[k]) * scale[k];
    const visible = (k, room) => [corner[k] - 0.5, corner[k] - 0.5 + room / scale[k]];
    context.textAlign = "center";
    context.textBaseline = "top";
    const across = this.x.ticks(visible(0, width), width / (90 * size));
    for (const [index, text] of across.marks) context.fillText(text, left + pixel(0, index), top + height + 7);
    context.fillText(across.label, left + width / 2, top + height + 9 + 14 * size);
    context.textAlign = "right";
    context.textBaseline = "middle";
    const up = this.y.ticks(visible(1, height), height / (45 * size));
    for (const [index, text] of up.marks) context.fillText(text, left - 8, top + height - pixel(1, index));
    writeUpward(context, up.label, top + height / 2);
  }

  /** Returns the point under a pointer, `[column, row]`, or null outside. */
  point({ clientX, clientY }) {
    if (!this.view) return null;
    const { left, top } = this.canvas.getBoundingClientRect();
    const [x, y, , height] = this.room();
    const found = [clientX - left - x, y + height - (clientY - top)].map((at, k) =>
      Math.floor(this.view.corner[k] + at / this.view.scale[k]));
    return found.every((at, k) => at >= 0 && at < this.size[k]) ? found : null;
  }

  /** Scales the view about a place, given as shares of the room from its lower left corner. */
  zoom(factor, share = [0.5, 0.5]) {
    const [, , width, height] = this.room();
    const { corner, scale } = this.fit();
    [width, height].forEach((room, k) => {
      const fixed = corner[k] + (share[k] * room) / scale[k];
      scale[k] *= factor;
      corner[k] = fixed - (share[k] * room) / scale[k];
    });
    this.draw();
  }

  wheel(event) {
    event.preventDefault();
    const { left, top } = this.canvas.getBoundingClientRect();
    const [x, y, width, height] = this.room();
    const share = [(event.clientX - left - x) / width, 1 - (event.clientY - top - y) / height];
    this.zoom(event.deltaY > 0 ? 1 / STEP : STEP, share);
  }

  down(event) {
    this.canvas.setPointerCapture(event.pointerId);
    this.from = [event.clientX, event.clientY];
    this.begun = this.from;
  }

  move(event) {
    this.onhover(this.point(event));
    if (!this.from) return;
    const { corner, scale } = this.fit();
    corner[0] -= (event.clientX - this.from[0]) / scale[0];
    corner[1] += (event.clientY - this.from[1]) / scale[1];
    this.from = [event.clientX, event.clientY];
    this.draw();
  }

  up(event) {
    const clicked = this.begun && Math.hypot(event.clientX - this.begun[0], event.clientY - this.begun[1]) <= CLICK;
    this.from = this.begun = null;
    const point = this.point(event);
    if (clicked && point) this.onpoint(point);
  }

  key({ key }) {
    const by = { ArrowLeft: [-MOVE, 0], ArrowRight: [MOVE, 0], ArrowDown: [0, -MOVE], ArrowUp: [0, MOVE] }[key];
    if (key === "+" || key === "-") this.zoom(key === "+" ? STEP : 1 / STEP);
    if (!by) return;
    const [, , width, height] = this.room();
    const { corner, scale } = this.fit();
    [width, height].forEach((room, k) => (corner[k] += (by[k] * room) / scale[k]));
    this.draw();
  }
}

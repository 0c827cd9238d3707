/** A plane of two channels that readers choose: points, darker where there are more. */

import { element } from "../interface/element.js";
import { prepared } from "../mechanism/canvas.js";
import { onNewColours, palette } from "../mechanism/palette.js";
import { drawAxes, extent, letters, scales } from "./axes.js";
import { drawCloud } from "./cloud.js";

export class Plane {
  /**
   * @param names channels to choose from
   * @param chosen `[across, up]`
   * @param onchoice called with the two names, whenever they are chosen anew
   */
  constructor(names, chosen, signal, onchoice) {
    Object.assign(this, { chosen: [...chosen] });
    this.canvas = element("canvas", { class: "canvas-plot", role: "img", "aria-label": "Points" });
    this.note = element("p", { class: "quiet small" });
    const select = (title, place) => {
      const id = `${title.toLowerCase()}-${Math.random().toString(36).slice(2)}`;
      const made = element("select", { id, onchange: () => {
        this.chosen[place] = made.value;
        onchoice([...this.chosen]);
      } }, names.map((name) => element("option", { value: name, selected: name === chosen[place] }, name)));
      return element("div", { class: "field" }, element("label", { for: id }, title), made);
    };
    this.element = element("div", {},
      element("div", { class: "filters channels" }, select("Across", 0), select("Up", 1)), this.canvas, this.note);
    onNewColours(() => this.draw(), signal);
    new ResizeObserver(() => this.draw()).observe(this.canvas);
  }

  /**
   * @param points `{x, y, names: [across, up], units: [across, up], words, note}`; `words` say what the
   *   points are, `names` are those of the points: others may be chosen that have not come
   */
  show(points) {
    this.points = points;
    this.draw();
  }

  draw() {
    if (!this.points || !this.canvas.clientWidth) return;
    const { x, y, names, units, words, note } = this.points;
    const colours = palette();
    const context = prepared(this.canvas);
    const { clientWidth, clientHeight } = this.canvas;
    const size = letters();
    const to = scales([88 * size, 10, clientWidth - 88 * size - 14, clientHeight - 12 - 44 * size], extent([x]), extent([y]));
    drawCloud(context, to, [{ x, y, colour: colours["curve-0"] }]);
    const [xLabel, yLabel] = names.map((name, i) => `${name} [${units[i]}]`);
    drawAxes(context, to, { xLabel, yLabel }, colours);
    this.canvas.setAttribute("aria-label", `${words}: ${names[1]} over ${names[0]}`);
    this.canvas.dataset.points = String(x.length);
    this.note.textContent = note || `${words}.`;
  }
}

/** Returns two channels to begin with: those of the address, else declared outputs, else `moving`. */
export function firstPlane(names, query) {
  const outputs = names.filter((name) => !name.includes("."));
  const likely = outputs.length > 1 ? outputs : moving(names);
  const known = (name) => (names.includes(name) ? name : null);
  return [known(query.get("x")) ?? likely[0], known(query.get("y")) ?? likely[1] ?? likely[0]];
}

/** Returns two channels that move in most mechanisms: of a joint with play, or of the last body; else all. */
function moving(names) {
  for (const [across, up] of [["eccentricity_x", "eccentricity_y"], ["penetration", "penetration_rate"],
    ["theta", "omega"]]) {
    const found = names.filter((name) => name.endsWith(`.${across}`)).at(across === "theta" ? -1 : 0);
    const other = found?.slice(0, -across.length) + up;
    if (names.includes(other)) return [found, other];
  }
  return names;
}

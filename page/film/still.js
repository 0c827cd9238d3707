/** A moment as SVG: the mechanism, its magnified joints below it. */

import { arrangement, MARGIN } from "./arrangement.js";
import { palette } from "../mechanism/palette.js";
import { frame } from "../mechanism/frame.js";
import { REACH } from "../mechanism/magnified.js";
import { svgFile, svgWords, written } from "../mechanism/svg.js";
import { svgElement } from "../interface/element.js";
import { withUnit } from "../interface/numbers.js";

/** Returns the file of a stage and its insets, or null instead of these, at a time. */
export async function still(stage, insets, time) {
  await stage.ready(time);
  stage.reach(time);
  const colours = palette();
  const state = stage.motions[0].at(time);
  if (!state) throw new Error("Nothing is computed at this time yet; choose an earlier one.");
  const joints = insets?.pictures(time, state) ?? [];
  const { clientWidth: wide, clientHeight: high } = stage.canvas;
  const { size, side, place } = arrangement(wide, high, joints.length);
  const parts = joints.map(({ name, force, factors, shapes }, i) => {
    const { left: x, top: y, words: [first, second] } = place(i);
    const viewBox = [-REACH, -REACH, 2 * REACH, 2 * REACH].join(" ");
    return [
      svgElement("svg", { x, y, width: side, height: side, viewBox },
        written(shapes, frame([0, 0, 0, 0], 0, 0), colours)),
      svgWords(`${name}, ${force}`, first, colours.ink),
      svgWords(factors, second, colours.quiet),
    ];
  });
  return svgFile([
    written(stage.shapes(state.pose, 0), stage.view(), colours),
    svgWords(`t = ${withUnit(time, "s", 4)}`, [MARGIN, MARGIN + 6], colours.ink),
    parts,
  ], size, colours.paper, `${stage.name} at ${time} s`);
}

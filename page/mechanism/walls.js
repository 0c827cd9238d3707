/** A slider in its guide, or a pin in its slot, magnified, as it stands in the world. */

import { marks, play } from "./placing.js";
import { DEEPEST, GAP, arrow, disc, line, polygon, shown } from "./magnified.js";

const SLIDER = 78; // half a slider's length, px
const PIN = 48; // radius, px
const SLIMMEST = 0.3; // height of a slider over its length, as it is drawn
const THICKEST = 0.7;
const WALL = { long: 105, thick: 13 }; // half its length, px

/**
 * Returns the shapes of a joint, and by what its gap and penetration are exaggerated.
 *
 * @param joint with its clearance: a block between walls, or a pin
 * @param heading angle of its axis in the world
 * @param contacts of its corners, or of its two walls: penetration and force now
 * @param limits the `strongest` force, N, and the `deepest` penetration, m
 */
export function walls(joint, heading, contacts, limits) {
  const { block, parts, size } = marks(joint);
  const gap = play(joint);
  const [length, height] = (block ?? []).map((field) => joint.clearance[field]);
  const isPin = !block;
  const half = isPin ? PIN : SLIDER * Math.min(Math.max(height / length, SLIMMEST), THICKEST);
  const [c, s] = [Math.cos(heading), Math.sin(heading)];
  const turned = ([along, across]) => [c * along - s * across, -s * along - c * across];
  const shapes = [1, -1].flatMap((side) => {
    const [inner, outer] = [side * (half + GAP), side * (half + GAP + WALL.thick)];
    const [from, to] = [turned([-WALL.long, inner]), turned([WALL.long, inner])];
    const beyond = [turned([WALL.long, outer]), turned([-WALL.long, outer])];
    return [
      polygon([from, to, ...beyond], { fill: "ground", stroke: "ground", width: 0.5 }),
      line([from, to], { colour: "edge", width: 1.6 }),
    ];
  });
  const positions = Object.values(parts);
  const touching = positions.map(([along, side], i) =>
    [along * SLIDER, side * (half + shown(contacts[i].penetration + gap, gap, limits))]);
  const look = { fill: "tint-0", stroke: "edge", width: 1.4 };
  if (isPin) {
    const nearest = contacts[0].penetration > contacts[1].penetration ? 0 : 1;
    const centre = turned([0, touching[nearest][1] - positions[nearest][1] * half]);
    shapes.push(disc(centre, half, look), disc(centre, 3, { fill: "trail" }));
  } else {
    shapes.push(polygon(touching.map(turned), look));
  }
  positions.forEach(([, side], i) => {
    shapes.push(...arrow(turned(touching[i]), turned([0, side]), contacts[i].normal_force, limits));
  });
  const drawn = (isPin ? joint.clearance[size] : height / 2) / half; // m of a px
  return { shapes, exaggerated: (GAP * drawn) / gap, deeper: (DEEPEST * drawn) / limits.deepest };
}

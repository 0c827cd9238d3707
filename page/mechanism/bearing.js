/**
 * A journal in its bearing, magnified, with its trail and the contact force.
 *
 * The bearing has the same size whatever its radius; the gap is drawn wider by a factor that is
 * shown, and penetration by a larger one, or nobody would see it.
 */

import { DEEPEST, GAP, arrow, disc, line, shown } from "./magnified.js";

const BEARING = 78; // radius, px
const FADING = 4; // parts of the trail

/**
 * Returns the shapes of a joint, and by what its gap and penetration are exaggerated.
 *
 * @param clearance the joint's clearance
 * @param contact eccentricity and force now
 * @param trail path of the journal's centre, m
 * @param limits the `strongest` force, N, and the `deepest` penetration, m
 */
export function bearing(clearance, contact, trail, limits) {
  const { radial_clearance: gap, bearing_radius: radius } = clearance;
  const { eccentricity_x: x, eccentricity_y: y, normal_force: force } = contact;
  const journal = BEARING - GAP;
  const position = (one) => pixels(one, gap, limits);
  const centre = position([x, y]);
  const size = Math.hypot(x, y) || 1e-300;
  const normal = [x / size, -y / size];
  const shapes = [
    disc([0, 0], BEARING + 13, { fill: "ground", stroke: "edge", width: 1 }),
    disc([0, 0], BEARING, { fill: "paper", stroke: "edge", width: 1.6 }),
    disc(centre, journal, { fill: "tint-0", stroke: "edge", width: 1.4 }),
    disc([0, 0], GAP, { stroke: "faint", width: 1 }),
  ];
  for (let part = 0; part < FADING; part++) {
    const from = Math.floor((trail.length * part) / FADING);
    const to = Math.floor((trail.length * (part + 1)) / FADING) + 1;
    const points = trail.slice(from, to).map(position);
    const alpha = 0.25 + (0.75 * (part + 1)) / FADING;
    if (points.length > 1) shapes.push(line(points, { colour: "trail", width: 1.3, alpha }));
  }
  shapes.push(disc(centre, 3, { fill: "trail" }));
  const tip = [centre[0] + normal[0] * journal, centre[1] + normal[1] * journal];
  shapes.push(...arrow(tip, normal, force, limits));
  const drawn = radius / BEARING; // m of a px
  return { shapes, exaggerated: (GAP * drawn) / gap, deeper: (DEEPEST * drawn) / limits.deepest };
}

function pixels([x, y], gap, limits) {
  const size = Math.hypot(x, y);
  if (size === 0) return [0, 0];
  const distance = shown(size, gap, limits);
  return [(x / size) * distance, (-y / size) * distance];
}

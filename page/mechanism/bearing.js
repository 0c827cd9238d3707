/**
 * A clearance joint, magnified: the journal in its bearing, its trail, and the contact force.
 *
 * The bearing has the same size whatever its radius; the gap is drawn wider by a factor that is
 * shown, and penetration by a larger one, or nobody would see it.
 */

const BEARING = 78; // radius, px
const GAP = 30; // width of the clearance, px
const LONGEST = 44; // arrow of the largest force, px
const DEEPEST = 12; // of penetration, px

/**
 * Returns the shapes of a joint, and by what its gap and penetration are exaggerated.
 *
 * @param clearance the joint's clearance
 * @param contact eccentricity and forces now
 * @param trail path of the journal's centre, m
 * @param strongest normal force of the longest arrow, N
 * @param deepest penetration that is drawn `DEEPEST` deep, m
 */
export function bearing(clearance, contact, trail, strongest, deepest) {
  const gap = clearance.radial_clearance;
  const { eccentricity_x: x, eccentricity_y: y, normal_force: force } = contact;
  const journal = BEARING - GAP;
  const centre = pixels([x, y], gap, deepest);
  const size = Math.hypot(x, y) || 1e-300;
  const normal = [x / size, -y / size];
  const at = (right, down) => [0, 0, right, down];
  const drawn = [
    { kind: "disc", points: [at(0, 0)], radius: BEARING + 13, fill: "ground", stroke: "edge", width: 1 },
    { kind: "disc", points: [at(0, 0)], radius: BEARING, fill: "paper", stroke: "edge", width: 1.6 },
    { kind: "disc", points: [at(...centre)], radius: journal, fill: "tint-0", stroke: "edge", width: 1.4 },
    { kind: "disc", points: [at(0, 0)], radius: GAP, stroke: "faint", width: 1 },
  ];
  const fading = 4;
  for (let part = 0; part < fading; part++) {
    const from = Math.floor((trail.length * part) / fading);
    const to = Math.floor((trail.length * (part + 1)) / fading) + 1;
    const points = trail.slice(from, to).map((one) => at(...pixels(one, gap, deepest)));
    if (points.length > 1) {
      const alpha = 0.25 + (0.75 * (part + 1)) / fading;
      drawn.push({ kind: "line", points, colour: "trail", width: 1.3, alpha });
    }
  }
  drawn.push({ kind: "disc", points: [at(...centre)], radius: 3, fill: "trail" });
  if (force > 0) drawn.push(...arrow(normal, centre, journal, (LONGEST * force) / strongest));
  const exaggerated = GAP / BEARING / (gap / clearance.bearing_radius);
  const deeper = (DEEPEST / deepest) / (BEARING / clearance.bearing_radius);
  return { shapes: drawn, exaggerated, deeper };
}

function pixels([x, y], gap, deepest) {
  const size = Math.hypot(x, y);
  if (size === 0) return [0, 0];
  const inside = (Math.min(size, gap) / gap) * GAP;
  const beyond = (Math.max(size - gap, 0) / deepest) * DEEPEST;
  const shown = inside + Math.min(beyond, 1.4 * DEEPEST);
  return [(x / size) * shown, (-y / size) * shown];
}

/** The force on the journal: it points away from the wall, its head at the contact. */
function arrow([nx, ny], [cx, cy], radius, length) {
  const tip = [cx + nx * radius, cy + ny * radius];
  const tail = [tip[0] + nx * length, tip[1] + ny * length];
  const wide = Math.min(5, length / 2);
  const neck = [tip[0] + nx * wide * 1.8, tip[1] + ny * wide * 1.8];
  const at = ([right, down]) => [0, 0, right, down];
  const head = [tip, [neck[0] - ny * wide, neck[1] + nx * wide], [neck[0] + ny * wide, neck[1] - nx * wide]];
  return [
    { kind: "line", points: [at(tail), at(neck)], colour: "force", width: 2.6 },
    { kind: "polygon", points: head.map(at), fill: "force", stroke: "force", width: 1 },
  ];
}

/** Measures of magnified joints: gaps and penetrations that can be seen, and arrows of forces. */

export const REACH = 140; // half the width of a picture, px
export const GAP = 30; // width that play is drawn with, px
export const DEEPEST = 12; // of the largest penetration, px
export const SHALLOWEST = 1e-9; // penetration up to which there is hardly one, m
const LONGEST = 44; // arrow of the largest force, px

/** Returns how far from the middle, in px, something is drawn that is `distance` from there, in m. */
export function shown(distance, play, { deepest }) {
  const inside = Math.min(distance / play, 1) * GAP;
  return inside + Math.min((Math.max(distance - play, 0) / deepest) * DEEPEST, 1.4 * DEEPEST);
}

/** Returns the shape of points `[right, down]` of a picture, px. */
export function line(points, look) {
  return { kind: "line", points: points.map(pixel), ...look };
}

/** Returns a polygon of points `[right, down]`, px. */
export function polygon(points, look) {
  return { kind: "polygon", points: points.map(pixel), ...look };
}

/** Returns a disc about a point `[right, down]`, px. */
export function disc(centre, radius, look) {
  return { kind: "disc", points: [pixel(centre)], radius, ...look };
}

function pixel([right, down]) {
  return [0, 0, right, down];
}

/** The force of a wall: it comes from beyond the wall, where the normal points, its head at `tip`. */
export function arrow(tip, [nx, ny], force, { strongest }) {
  if (!(force > 0)) return [];
  const length = (LONGEST * force) / strongest;
  const wide = Math.min(5, length / 2);
  const along = (share) => [tip[0] + nx * share, tip[1] + ny * share];
  const neck = along(1.8 * wide);
  const head = [tip, [neck[0] - ny * wide, neck[1] + nx * wide], [neck[0] + ny * wide, neck[1] - nx * wide]];
  return [
    line([along(length), neck], { colour: "force", width: 2.6 }),
    polygon(head, { fill: "force", stroke: "force", width: 1 }),
  ];
}

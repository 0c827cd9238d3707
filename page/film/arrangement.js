/** Places in a picture that is kept: the mechanism above, its magnified joints in rows below. */

const LEAST = 200; // width of a magnified joint, px
const CAPTION = 44; // height of its words, px
export const MARGIN = 14; // of words, px

/**
 * Returns the `size` of the picture, the `side` of a magnified joint, and `place(i)`: where the
 * joint's picture has its corner, and its two lines of words begin; all px.
 */
export function arrangement(wide, high, joints) {
  const columns = Math.max(1, Math.min(joints, Math.floor(wide / LEAST)));
  const column = wide / columns;
  const side = Math.min(column, 1.4 * LEAST);
  return {
    size: [wide, high + Math.ceil(joints / columns) * (side + CAPTION)],
    side,
    place(i) {
      const left = (i % columns) * column + (column - side) / 2;
      const top = high + Math.floor(i / columns) * (side + CAPTION);
      const words = [10, 28].map((below) => [left + MARGIN, top + side + below]);
      return { left, top, words };
    },
  };
}

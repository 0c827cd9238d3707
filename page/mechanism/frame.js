/** A frame: how positions in the world come to pixels of a picture. */

/** Returns the frame that shows a box `[left, low, right, high]` in a picture of pixels. */
export function frame(box, width, height, margin = 34) {
  const [left, low, right, high] = box;
  const room = [Math.max(width - 2 * margin, 20), Math.max(height - 2 * margin, 20)];
  const scale = Math.min(room[0] / Math.max(right - left, 1e-12), room[1] / Math.max(high - low, 1e-12));
  const middle = [(left + right) / 2, (low + high) / 2];
  return {
    width,
    height,
    scale,
    /** Returns the pixel of a point `[x, y, right, down]`. */
    pixel: ([x, y, dx = 0, dy = 0]) => [
      width / 2 + (x - middle[0]) * scale + dx, height / 2 - (y - middle[1]) * scale + dy,
    ],
    /** Returns the position in the world of a pixel. */
    position: (right, down) => [
      middle[0] + (right - width / 2) / scale, middle[1] - (down - height / 2) / scale,
    ],
  };
}

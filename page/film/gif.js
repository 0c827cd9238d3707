/** A GIF of a reel, all frames with the colours of the first and those that forces may bring later. */

import { GIFEncoder, applyPalette, quantize } from "../vendor/gifenc/gifenc.esm.js";
import { palette } from "../mechanism/palette.js";

export const RATE = 20; // frames a second
export const LIMITS = { widest: 640, most: 640 * 900 }; // px
const UNIT = 10; // delays of frames are multiples of this, ms
const COLOURS = 128; // of the first frame

/** Returns the GIF. */
export async function gif(reel, tell) {
  const encoder = GIFEncoder();
  const { width, height, length } = reel;
  const end = (index) => UNIT * Math.round((1000 * reel.seconds * index) / length / UNIT);
  let colours = null;
  for (let index = 0; index < length; index++) {
    tell(`Frame ${index + 1} of ${length} …`);
    await reel.draw(index);
    await new Promise((resolve) => setTimeout(resolve, 0)); // the page stays alive
    const { data } = reel.context.getImageData(0, 0, width, height);
    colours ??= [...quantize(data, COLOURS), ...named(reel.context)];
    encoder.writeFrame(applyPalette(data, colours), width, height, {
      palette: index ? undefined : colours, delay: Math.max(UNIT, end(index + 1) - end(index)),
    });
  }
  encoder.finish();
  return new Blob([encoder.bytes()], { type: "image/gif" });
}

/** Returns the colours of drawings as `[red, green, blue]`: some may not be in the first frame. */
function named(context) {
  return Object.values(palette()).map((colour) => {
    context.fillStyle = colour; // a canvas gives it back as #rrggbb
    return [1, 3, 5].map((at) => parseInt(context.fillStyle.slice(at, at + 2), 16));
  });
}

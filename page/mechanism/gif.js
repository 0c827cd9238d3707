/** A GIF of a stage, from the time that is shown on. */

import { GIFEncoder, applyPalette, quantize } from "../vendor/gifenc/gifenc.esm.js";

const FRAMES = 80;
const DELAY = 50; // ms
const WIDEST = 640; // px

/** Returns the GIF: 4 s of film at the clock's speed. */
export async function gif(stage, clock, tell) {
  const from = clock.time;
  clock.stop();
  const { canvas } = stage;
  const scale = Math.min(1, WIDEST / canvas.clientWidth);
  const width = Math.round(canvas.clientWidth * scale);
  const height = Math.round(canvas.clientHeight * scale);
  const small = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
  small.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--paper");
  const encoder = GIFEncoder();
  let colours = null;
  const step = (DELAY / 1000) * clock.speed;
  for (let frame = 0; frame < FRAMES && from + frame * step <= clock.last; frame++) {
    tell(`Frame ${frame + 1} of ${FRAMES} …`);
    clock.seek(from + frame * step);
    await new Promise((resolve) => setTimeout(resolve, 0));
    small.fillRect(0, 0, width, height);
    small.drawImage(canvas, 0, 0, width, height);
    const { data } = small.getImageData(0, 0, width, height);
    colours ??= quantize(data, 128);
    encoder.writeFrame(applyPalette(data, colours), width, height, {
      palette: frame ? undefined : colours, delay: DELAY,
    });
  }
  encoder.finish();
  clock.seek(from);
  return new Blob([encoder.bytes()], { type: "image/gif" });
}

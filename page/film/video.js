/** Videos of a reel, encoded by the browser picture by picture: no frame is lost on a slow machine. */

import { mp4 } from "./mp4.js";
import { webm } from "./webm.js";

export const RATE = 30; // frames a second
export const LIMITS = { widest: 1920, most: 1920 * 1080, even: true }; // px; what level 4 decodes
const KEY_FRAMES = 2 * RATE; // a player can begin at each of these
const WAITING = 4; // pictures in the encoder
const BITS = 0.15; // a pixel and frame
const FORMS = {
  mp4: { codec: "avc1.42E028", avc: { format: "avc" }, type: "video/mp4", file: mp4 },
  webm: { codec: "vp09.00.40.08", type: "video/webm", file: webm },
};

/** Returns the video: `form` is mp4 or webm. */
export async function video(form, reel, tell) {
  const { type, file, ...codec } = FORMS[form];
  const { width, height, length, seconds } = reel;
  const bitrate = Math.round(BITS * width * height * RATE);
  const config = { ...codec, width, height, bitrate, framerate: length / seconds };
  if (!(await window.VideoEncoder?.isConfigSupported(config))?.supported) {
    throw new Error(window.isSecureContext
      ? `This browser makes no ${form} files; take another form.`
      : "Browsers make videos for https and for localhost alone; take the GIF.");
  }
  const frames = [];
  let [described, trouble] = [null, null];
  const encoder = new VideoEncoder({
    output(chunk, { decoderConfig }) {
      described ??= decoderConfig?.description;
      const data = new Uint8Array(chunk.byteLength);
      chunk.copyTo(data);
      frames.push({ data, isKey: chunk.type === "key" });
    },
    error: (error) => (trouble = error),
  });
  encoder.configure(config);
  try {
    for (let index = 0; index < length && !trouble; index++) {
      tell(`Frame ${index + 1} of ${length} …`);
      await reel.draw(index);
      const timestamp = Math.round((1e6 * seconds * index) / length);
      const picture = new VideoFrame(reel.canvas, { timestamp });
      encoder.encode(picture, { keyFrame: index % KEY_FRAMES === 0 });
      picture.close();
      await queued(encoder);
    }
    if (!trouble) await encoder.flush();
  } finally {
    if (encoder.state !== "closed") encoder.close();
  }
  if (trouble) throw trouble;
  return new Blob(file({ frames, width, height, seconds, described }), { type });
}

/** Waits until the encoder can take more; the page stays alive meanwhile. */
async function queued(encoder) {
  do {
    await new Promise((resolve) => setTimeout(resolve, 0));
  } while (encoder.encodeQueueSize > WAITING && encoder.state === "configured");
}

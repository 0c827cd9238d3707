/** Films of a mechanism and its magnified joints: GIF, MP4 or WebM. */

import { gif, LIMITS as OF_GIF, RATE as GIF_RATE } from "./gif.js";
import { Reel } from "./reel.js";
import { video, LIMITS as OF_VIDEO, RATE as VIDEO_RATE } from "./video.js";

/** Returns the file; `tell` is called with words about how far it is. */
export async function film(form, stage, insets, stretch, tell) {
  const reel = form === "gif"
    ? new Reel(stage, insets, stretch, GIF_RATE, OF_GIF)
    : new Reel(stage, insets, stretch, VIDEO_RATE, OF_VIDEO);
  await reel.load(tell);
  return form === "gif" ? gif(reel, tell) : video(form, reel, tell);
}

/** A film of a stage, recorded by the browser as its clock runs: MP4 where it can, else WebM. */

const LONGEST = 12; // s of film
const TYPES = [["video/mp4;codecs=avc1.42E01E", "mp4"], ["video/mp4", "mp4"], ["video/webm", "webm"]];

/** Returns `{blob, suffix}` of the film from the time that is shown, at the clock's speed. */
export async function film(stage, clock, tell) {
  const [type, suffix] = TYPES.find(([one]) => window.MediaRecorder?.isTypeSupported(one)) ?? [];
  if (!type) throw new Error("This browser records no films; take the GIF.");
  const recorder = new MediaRecorder(stage.canvas.captureStream(30), { mimeType: type });
  const parts = [];
  recorder.addEventListener("dataavailable", ({ data }) => parts.push(data));
  const ended = new Promise((resolve) => recorder.addEventListener("stop", resolve));
  const seconds = Math.min(LONGEST, (clock.last - clock.time) / clock.speed || LONGEST);
  recorder.start();
  clock.play();
  tell(`Recording ${seconds.toFixed(1)} s …`);
  await new Promise((resolve) => setTimeout(resolve, seconds * 1000));
  clock.stop();
  recorder.stop();
  await ended;
  return { blob: new Blob(parts, { type: type.split(";")[0] }), suffix };
}

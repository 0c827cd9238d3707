/** Follows one job: what happens to it, and how far it is, until it is finished. */

import { report } from "./service.js";

const HISTORY = [
  "queued", "running", "claimed", "compiling", "released", "lost", "cancelling",
  "succeeded", "failed", "cancelled",
];
export const TERMINAL = new Set(["succeeded", "failed", "cancelled"]);

/**
 * Opens the stream of a job's events; the browser comes back by itself when it is cut, and misses
 * nothing. Closed when the job is finished or `signal` is aborted.
 *
 * @param onEvent called with each event of the history, once
 * @param onProgress called with the newest state and progress
 */
export function follow(address, { onEvent, onProgress, signal }) {
  let seen = 0;
  const stream = new EventSource(`${address}/events`);
  const close = () => stream.close();
  signal.addEventListener("abort", close, { once: true });
  stream.addEventListener("open", () => report(true));
  stream.addEventListener("error", () => {
    if (stream.readyState !== EventSource.CLOSED) report(false);
  });
  for (const type of HISTORY) {
    stream.addEventListener(type, (message) => {
      const event = JSON.parse(message.data);
      if (event.seq <= seen) return;
      seen = event.seq;
      onEvent?.(event);
    });
  }
  stream.addEventListener("progress", (message) => {
    const now = JSON.parse(message.data);
    if (TERMINAL.has(now.state)) close();
    onProgress?.(now);
  });
}

/** Follows one job: what happens to it, and how far it is, until it is finished. */

import { keyHeaders } from "./key.js";
import { mayPass, pause, report } from "./service.js";

export const TERMINAL = new Set(["succeeded", "failed", "cancelled"]);
const COME_BACK = 1000; // ms after which a stream that was cut is opened again

/**
 * Reads the stream of a job's events; comes back where it is cut, and misses nothing. It ends when
 * the job is finished or `signal` is aborted. (The browser's own EventSource shows no key.) While the
 * tab is hidden there is no stream: all tabs together have six connections to a service.
 *
 * @param onEvent called with each event of the history, once
 * @param onProgress called with the newest state and progress
 * @param onLost called if there is nothing more to be read, though no end was told
 */
export async function follow(address, { onEvent, onProgress, onLost, signal }) {
  let last = 0;
  let over = false;
  const take = (message) => {
    if (message.event === "progress") {
      const now = JSON.parse(message.data);
      over = TERMINAL.has(now.state);
      onProgress?.(now);
    } else if (message.data) {
      last = Number(message.id);
      onEvent?.(JSON.parse(message.data));
    }
  };
  while (!over && !signal.aborted) {
    const stream = untilHidden(signal);
    try {
      await seen(signal);
      const known = last ? { "Last-Event-ID": String(last) } : {};
      const headers = { ...keyHeaders(), ...known };
      const answer = await fetch(`${address}/events`, { headers, signal: stream.signal });
      report(true);
      if (answer.status === 200) await read(answer.body, take);
      else if (!mayPass(answer)) return onLost?.();
      if (!over) await pause(COME_BACK, signal);
    } catch (error) {
      if (signal.aborted) return;
      if (stream.signal.aborted) continue; // the tab was hidden
      report(false);
      await pause(COME_BACK, signal).catch(() => {});
    } finally {
      stream.end();
    }
  }
}

/** Waits until the tab is seen; throws AbortError where the view is left before. */
function seen(signal) {
  return new Promise((resolve, reject) => {
    const heard = new AbortController();
    const look = () => {
      if (!signal.aborted && document.hidden) return;
      heard.abort();
      if (signal.aborted) reject(new DOMException("The view was left.", "AbortError"));
      else resolve();
    };
    document.addEventListener("visibilitychange", look, { signal: heard.signal });
    signal.addEventListener("abort", look, { signal: heard.signal });
    look();
  });
}

/** Returns a `signal` that is aborted when the tab is hidden after it was seen, or the view is left; `end` forgets it. */
function untilHidden(left) {
  const [stream, heard] = [new AbortController(), new AbortController()];
  const leave = () => (left.aborted || document.hidden) && stream.abort();
  left.addEventListener("abort", leave, { signal: heard.signal });
  document.addEventListener("visibilitychange", leave, { signal: heard.signal });
  return { signal: stream.signal, end: () => heard.abort() };
}

/** Takes messages apart: lines `field: value`, an empty line after each message. */
async function read(body, take) {
  const reader = body.pipeThrough(new TextDecoderStream()).getReader();
  let text = "";
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return;
    const messages = (text + value).replaceAll("\r\n", "\n").split("\n\n");
    text = messages.pop();
    for (const message of messages) {
      const lines = message.split("\n").map((line) => /^(\w+): ?(.*)$/.exec(line)).filter(Boolean);
      take(Object.fromEntries(lines.map(([, field, content]) => [field, content])));
    }
  }
}

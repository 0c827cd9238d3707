/** Follows one job: what happens to it, and how far it is, until it is finished. */

import { keyHeaders } from "./key.js";
import { mayPass, pause, report } from "./service.js";

export const TERMINAL = new Set(["succeeded", "failed", "cancelled"]);
const COME_BACK = 1000; // ms after which a stream that was cut is opened again

/**
 * Reads the stream of a job's events; comes back where it is cut, and misses nothing. It ends when
 * the job is finished or `signal` is aborted. (The browser's own EventSource shows no key.)
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
    try {
      const seen = last ? { "Last-Event-ID": String(last) } : {};
      const answer = await fetch(`${address}/events`, { headers: { ...keyHeaders(), ...seen }, signal });
      report(true);
      if (answer.status === 200) await read(answer.body, take);
      else if (!mayPass(answer)) return onLost?.();
      if (!over) await pause(COME_BACK, signal);
    } catch (error) {
      if (error.name === "AbortError") return;
      report(false);
      await pause(COME_BACK, signal).catch(() => {});
    }
  }
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

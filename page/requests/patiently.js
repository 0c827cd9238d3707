/** Asks a service again that is busy, or does not answer for a moment. */

import { Unreachable, pause } from "./service.js";

const BUSY = new Set([429, 503]);
const TRIES = 5;
const COME_BACK = 1000; // ms

/** Returns what `ask` returns; what asks must be safe to be sent again. */
export async function patiently(ask, signal) {
  for (let tries = 1; ; tries++) {
    try {
      return await ask();
    } catch (error) {
      const again = BUSY.has(error.status) || error instanceof Unreachable;
      if (!again || tries === TRIES) throw error;
      await pause(COME_BACK, signal);
    }
  }
}

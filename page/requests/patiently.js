/** Asks a service again that is busy, or does not answer for a moment. */

import { Unreachable, isBusy, mayPass, pause } from "./service.js";

const TRIES = 5;
const COME_BACK = 1; // s
const LONGEST = 10; // s: who would have to wait longer is told so

/** Returns what `ask` returns; what asks must be safe to be sent again. */
export async function patiently(ask, signal, again = (error) => isBusy(error) || error instanceof Unreachable) {
  for (let tries = 1; ; tries++) {
    try {
      return await ask();
    } catch (error) {
      const after = error.after ?? COME_BACK;
      if (!again(error) || tries === TRIES || after > LONGEST) throw error;
      await pause(1000 * after, signal);
    }
  }
}

/** Returns what `ask` returns, for however long the service is away, and busy or broken unless `away`. */
export async function untilAnswered(ask, signal, { away = false } = {}) {
  for (;;) {
    try {
      return await ask();
    } catch (error) {
      if (!(error instanceof Unreachable || (!away && mayPass(error)))) throw error;
      await pause(1000 * (error.after ?? COME_BACK), signal);
    }
  }
}

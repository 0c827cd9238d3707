/** One request after the other: of what is wanted while one is on its way, only the newest is sent. */

import { Problem, Unreachable, pause } from "./service.js";

export class Newest {
  /**
   * @param send sends what is wanted, and takes the answer
   * @param rate requests a second at most
   * @param told called with whether anything that is wanted is not answered yet
   */
  constructor(send, { rate = Infinity, told = () => {} } = {}) {
    Object.assign(this, { send, least: 1000 / rate, told, next: null, busy: false });
  }

  /** Leaves what waits unsent. */
  drop() {
    this.next = null;
  }

  /** Has something sent, now or as soon as what was sent before is answered. */
  async want(what) {
    this.next = { what };
    if (this.busy) return;
    this.told(this.busy = true);
    try {
      while (this.next) {
        const { what: now } = this.next;
        this.next = null;
        const begun = performance.now();
        await this.send(now).catch(pass);
        const left = this.least - (performance.now() - begun);
        if (left > 0) await pause(left);
      }
    } finally {
      this.told(this.busy = false);
    }
  }
}

/** Passes over what the page tells elsewhere: a scene that is wrong, a service that is away. */
function pass(error) {
  const told = error instanceof Problem || error instanceof Unreachable || error.name === "AbortError";
  if (!told) throw error;
}

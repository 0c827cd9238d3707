/** Simulated time that is shown: it stands, or runs slower or faster than real time. */

export class Clock {
  /** @param first, last bounds of the time, s */
  constructor(first, last) {
    Object.assign(this, { first, last, time: first, speed: 1, playing: false });
    this.listeners = new Set();
  }

  /** Calls `listener` with the time whenever it changes, or playing does. */
  listen(listener) {
    this.listeners.add(listener);
  }

  /** Goes to a time. */
  seek(time) {
    this.time = Math.min(Math.max(time, this.first), this.last);
    this.tell();
  }

  /** Sets what can be shown; what is beyond is not computed yet. */
  extend(last) {
    this.last = last;
    this.tell();
  }

  play() {
    if (this.playing) return;
    if (this.time >= this.last) this.time = this.first;
    this.playing = true;
    const run = (this.run = {}); // frames of one that was stopped may still come
    let before = null;
    const step = (now) => {
      if (this.run !== run) return;
      const passed = before === null ? 0 : Math.min(now - before, 100) / 1000;
      before = now;
      this.time += passed * this.speed;
      if (this.time >= this.last) this.time = this.first;
      this.tell();
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
    this.tell();
  }

  stop() {
    this.playing = false;
    this.run = null;
    this.tell();
  }

  tell() {
    for (const listener of this.listeners) listener(this.time, this);
  }
}

/** Tiles of a chart: asked for once, a few at a time, and kept while they are likely to be wanted. */

import { Problem, getBytes, mayPass, pause, withQuery } from "../requests/service.js";

const TOGETHER = 6; // requests on their way
const COME_BACK = 5000; // ms after which a tile is asked for again that did not come
const KEPT = 300; // tiles, of 256 kB each

export class Tiles {
  /**
   * @param path of the quantity's tiles
   * @param query of all of them
   * @param arrived called when a tile has come
   * @param before tiles whose pictures are shown until these have come, or null
   */
  constructor(path, query, signal, arrived, before = null) {
    Object.assign(this, { path, query, signal, arrived, underWay: 0, earlier: before?.known ?? new Map() });
    this.known = new Map(); // pictures by name, the one that was used last at the end; null: on its way, or it did not come
    this.wanted = [];
    this.next = [];
  }

  /** Returns a tile's picture; one that is not there is asked for, and meanwhile is that from before. */
  get(z, x, y) {
    const name = `${z}/${x}/${y}`;
    const picture = this.known.get(name);
    if (picture === undefined) this.wanted.push(name);
    if (!picture) return this.earlier.get(name) ?? null;
    this.known.delete(name);
    this.known.set(name, picture);
    return picture;
  }

  /** Returns how many tiles of those that were wanted last have not come. */
  waiting() {
    return this.underWay + this.next.length;
  }

  /** Sends for what was wanted since the last call, and for nothing that was wanted before. */
  send() {
    const [now, names] = [this.wanted, new Set()];
    this.wanted = [];
    for (const name of now) names.add(name);
    this.next = [...names];
    while (this.underWay < TOGETHER && this.next.length) this.fetch(this.next.shift());
  }

  async fetch(name) {
    this.underWay += 1;
    this.known.set(name, null);
    try {
      const bytes = await getBytes(withQuery(`${this.path}/${name}.png`, this.query), "image/png", this.signal);
      this.known.set(name, await createImageBitmap(new Blob([bytes], { type: "image/png" })));
      for (const old of this.known.keys()) {
        if (this.known.size <= KEPT) break;
        if (this.known.get(old)) this.known.delete(old);
      }
    } catch (error) {
      if (error.name === "AbortError") return;
      if (!(error instanceof Problem) || mayPass(error)) this.again(name);
    } finally {
      this.underWay -= 1;
    }
    this.arrived(); // so that the next is sent for, whether it came or not
  }

  /** Has a tile asked for again, after a while, if it is wanted still. */
  again(name) {
    pause(COME_BACK, this.signal).then(() => {
      this.known.delete(name);
      this.arrived();
    }, () => {}); // the view was left
  }
}

/** Wheel and pointer on a plot of a history: zoom, pan, and a click that sets the clock. */

const CLICK = 4; // px within which a drag is a click

export class Panning {
  /** @param plot a uPlot, @param history the `HistoryPlots` that it belongs to */
  constructor(plot, history) {
    Object.assign(this, { plot, history });
    const { over } = plot;
    over.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    over.addEventListener("pointerdown", (event) => this.down(event), { capture: true });
    over.addEventListener("dblclick", () => history.setWindow([...history.all]));
    over.addEventListener("click", (event) => this.click(event));
  }

  time({ clientX }) {
    const { left } = this.plot.over.getBoundingClientRect();
    return this.plot.posToVal(clientX - left, "x");
  }

  wheel(event) {
    event.preventDefault();
    if (event.ctrlKey || event.metaKey || Math.abs(event.deltaY) > Math.abs(event.deltaX)) {
      this.history.zoom(event.deltaY > 0 ? 1.25 : 0.8, this.time(event));
    } else {
      this.history.move(event.deltaX / this.plot.over.clientWidth);
    }
  }

  down(event) {
    this.from = event.clientX;
    if (!event.shiftKey) return;
    event.preventDefault();
    event.stopImmediatePropagation(); // no selection begins
    let before = event.clientX;
    const moved = (next) => {
      this.history.move((before - next.clientX) / this.plot.over.clientWidth);
      before = next.clientX;
    };
    const over = new AbortController();
    addEventListener("pointermove", moved, { signal: over.signal });
    for (const end of ["pointerup", "pointercancel"]) addEventListener(end, () => over.abort(), { signal: over.signal });
  }

  click(event) {
    if (Math.abs(event.clientX - this.from) > CLICK || event.shiftKey) return;
    this.history.clock.stop();
    this.history.clock.seek(this.time(event));
  }
}

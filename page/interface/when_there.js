/** Results that may not be there yet: asked for again as the job goes on. */

import { element, fill } from "./element.js";
import { TERMINAL } from "../requests/following.js";
import { Problem, get } from "../requests/service.js";

const LEAST = 1000; // ms between two questions

/**
 * Shows what a GET answers; again whenever the job has gone on, until it is finished.
 *
 * @param draw called with the answer
 */
export async function whenThere(room, { job, signal, onChange }, path, query, draw) {
  let asked = 0;
  let complete = false;
  const ask = async () => {
    asked = performance.now();
    try {
      const answer = await get(path, query, signal);
      complete = TERMINAL.has(job.state);
      await draw(answer);
    } catch (error) {
      if (!(error instanceof Problem) || ![404, 409].includes(error.status)) throw error;
      complete = TERMINAL.has(job.state);
      fill(room, nothing(error.message));
    }
  };
  onChange(({ state, progress }) => {
    if (complete || (!TERMINAL.has(state) && !progress.fraction)) return;
    if (asked && !TERMINAL.has(state) && performance.now() - asked < LEAST) return;
    ask().catch(() => {});
  });
  if (TERMINAL.has(job.state) || job.progress.fraction) await ask();
  else fill(room, nothing("The first results are shown here as soon as they are stored."));
}

function nothing(sentence) {
  return element("div", { class: "panel" }, element("h2", {}, "Nothing to see yet"),
    element("p", {}, sentence));
}

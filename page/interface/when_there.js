/** Results that may not be there yet: asked for again as the job goes on. */

import { element, fill } from "./element.js";
import { TERMINAL } from "../requests/following.js";
import { Newest } from "../requests/newest.js";
import { Problem, get } from "../requests/service.js";

const LEAST = 1000; // ms between two questions

/**
 * Shows what a GET answers; again whenever the job has gone on, until it was finished when it was asked.
 *
 * @param query of the GET, or a function that returns it as the reader has chosen by now
 * @param draw called with the answer
 * @param ends states of a job that has ended in which there is something, if there is nothing before
 */
export async function whenThere(room, { job, signal, onChange }, path, query, draw, ends = null) {
  const begun = ({ state, progress }) =>
    ends ? ends.includes(state) : TERMINAL.has(state) || progress.fraction > 0;
  const wait = ({ state }) => fill(room, nothing(
    !ends ? "The first results are shown here as soon as they are stored."
      : TERMINAL.has(state) ? `The job is ${state}: there will be nothing here.`
      : "This is known, and shown here, when the job has ended."));
  let asked = 0;
  let complete = false;
  let failed = null;
  const ask = async () => {
    asked = performance.now();
    failed = null;
    const over = TERMINAL.has(job.state); // it may end before the answer comes
    try {
      const answer = await get(path, typeof query === "function" ? query() : query, signal);
      complete = over;
      await draw(answer);
    } catch (error) {
      if (!(error instanceof Problem) || ![404, 409].includes(error.status)) throw (failed = error);
      complete = over;
      fill(room, nothing(error.message));
    }
  };
  const questions = new Newest(ask);
  onChange((now) => {
    if (complete) return;
    if (!begun(now)) {
      if (ends && TERMINAL.has(now.state)) wait(now);
      return;
    }
    if (asked && !TERMINAL.has(now.state) && performance.now() - asked < LEAST) return;
    questions.want().catch(() => {});
  });
  if (!begun(job)) return wait(job);
  await questions.want();
  if (failed) throw failed;
}

function nothing(sentence) {
  return element("div", { class: "panel" }, element("h2", {}, "Nothing to see yet"),
    element("p", {}, sentence));
}

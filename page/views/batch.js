/** A batch: how many of its jobs are in each state, and the jobs in the order of the request. */

import { button } from "../interface/button.js";
import { element, refill } from "../interface/element.js";
import { declaredFor, differing } from "../interface/job_words.js";
import { span } from "../interface/numbers.js";
import { address, go } from "../interface/route.js";
import { sceneName, stateMark } from "../interface/state.js";
import { tableOf } from "../interface/table.js";
import { get, mayPass, pause, post, remove } from "../requests/service.js";
import { counts } from "./batches.js";

const SHOWN = 200;

export async function show(room, { parts, signal }) {
  const path = `/v1/batches/${encodeURIComponent(parts[0] ?? "")}`;
  const acting = { signal, busy: false, said: "", redraw: () => {} };
  for (;;) {
    try {
      const batch = await get(path, {}, signal);
      const { jobs } = await get(`${path}/jobs`, { page_size: SHOWN }, signal);
      const declared = jobs.length ? await declaredFor(jobs[0].job) : {};
      const words = differing(jobs, declared);
      acting.redraw = () => draw(room, batch, jobs, words, buttons(batch, path, acting));
      acting.redraw();
      if (batch.finished) return;
    } catch (error) {
      if (!mayPass(error) || !room.childElementCount) throw error;
    }
    await pause(1500, signal);
  }
}

function draw(room, batch, jobs, words, acts) {
  refill(
    room,
    element("div", { class: "head" }, element("h1", {}, batch.label || "Batch"),
      element("div", { class: "buttons" },
        acts,
        element("a", { class: "button", href: "#/batches" }, "All batches"))),
    element("p", {}, counts(batch.states ?? {})),
    !batch.finished && element("progress", {
      max: 1, value: batch.progress.fraction, "aria-label": "Progress of the batch",
    }),
    element("section", { class: "panel" },
      tableOf("Jobs", ["Job", "State", "Progress", "In what they differ"], jobs.map((job, i) => row(job, words[i])), "roomy"),
      batch.jobs > jobs.length &&
        element("p", { class: "quiet small" }, `The first ${jobs.length} of ${batch.jobs} are shown.`)),
  );
}

/**
 * Returns what can be done with all of a batch, or with those that did not succeed, and what came of it.
 *
 * @param acting `{signal, busy, said, redraw}`: whether something is being done, and why the last thing was not
 */
function buttons(batch, path, acting) {
  const done = (now) => {
    Object.assign(acting, now);
    if (!acting.signal.aborted) acting.redraw();
  };
  const acts = (text, act) => button(text, () => { // it is drawn anew meanwhile
    if (acting.busy) return;
    done({ busy: true, said: "" });
    act().then(() => done({ busy: false }), ({ message }) => done({ busy: false, said: message }));
  }, { "aria-disabled": acting.busy && "true" });
  const { failed = 0, cancelled = 0 } = batch.states;
  const retry = async () => go(["batch", (await post(`${path}/retry`)).id]);
  const all = async () => {
    if (!confirm(`Delete this batch with its ${batch.jobs} jobs and their results?`)) return;
    await remove(path);
    go(["batches"]);
  };
  return [
    acting.said && element("span", { role: "alert" }, acting.said),
    failed + cancelled > 0 && acts(`Retry ${failed + cancelled}`, retry),
    batch.finished ? acts("Delete", all) : acts("Cancel all", () => post(`${path}/cancel`)),
  ];
}

function row(job, words) {
  const took = job.started && job.finished && (Date.parse(job.finished) - Date.parse(job.started)) / 1000;
  return element("tr", {},
    element("td", {}, element("a", { href: address(["job", job.id]) }, job.label || sceneName(job.job))),
    element("td", {}, stateMark(job.state)),
    element("td", {}, job.finished ? (took ? `took ${span(took)}` : "–") : element("progress", {
      max: 1, value: job.progress.fraction, "aria-label": "Progress",
    })),
    element("td", { class: "quiet" }, job.error ? job.error.detail : words || "–"));
}

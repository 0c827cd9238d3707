/** One job in a list. */

import { deleteJob, mayDelete, retriable, retryJob } from "./acting.js";
import { workButton } from "./button.js";
import { element, fill, refill } from "./element.js";
import { ago, span } from "./numbers.js";
import { address } from "./route.js";
import { progressWords, sceneName, stateMark } from "./state.js";
import { TERMINAL } from "../requests/following.js";
import { get, post } from "../requests/service.js";

export class JobRow {
  /** @param acts `choose(job, chosen)`, `gone(job)`, and `chosen` */
  constructor(job, acts) {
    Object.assign(this, { job, acts });
    this.box = element("input", {
      type: "checkbox", checked: acts.chosen,
      "aria-label": `Choose ${job.label || sceneName(job.job)}`,
      onchange: () => acts.choose(this.job, this.box.checked),
    });
    this.mark = element("span");
    this.progress = element("div", { class: "parameters small quiet" });
    this.cost = element("span", { class: "cost small quiet" });
    this.when = element("span", { class: "when small quiet", title: job.created });
    this.buttons = element("span", { class: "buttons" });
    const title = job.label || sceneName(job.job).replaceAll("-", " ");
    const kind = job.kind === "simulate" ? "" : ` · ${job.kind}`;
    this.element = element("div", { class: "row", role: "listitem", "data-job": job.id },
      this.box, this.mark,
      element("div", {},
        element("a", { href: address(["job", job.id]) }, `${title}${kind}`),
        element("div", { class: "small quiet" }, job.label ? sceneName(job.job) : "")),
      this.progress,
      this.when, this.cost, this.buttons);
  }

  /** Shows the job as it is now, at a height in px. */
  update(job, top) {
    this.job = job;
    this.element.style.transform = `translateY(${top}px)`;
    const submitted = ago(job.created);
    if (this.when.textContent !== submitted) this.when.textContent = submitted;
    const now = `${job.state} ${job.progress.fraction} ${job.activity}`;
    if (now === this.shown) return;
    this.shown = now;
    fill(this.mark, stateMark(job.state));
    fill(this.progress, TERMINAL.has(job.state) ? parameters(job) : [
      progressWords(job),
      element("progress", { max: 1, value: job.progress.fraction, "aria-label": "Progress" }),
    ]);
    const took = job.started && job.finished &&
      (Date.parse(job.finished) - Date.parse(job.started)) / 1000;
    this.cost.textContent = took ? `took ${span(took)}` : "";
    refill(this.buttons, TERMINAL.has(job.state)
      ? [retriable(job)
           ? this.button("Retry", () => retryJob(job))
           : this.button("Again", async () => {
               const { job: document } = await get(`/v1/jobs/${job.id}`);
               await post("/v1/jobs", { ...document, cache: false });
             }),
         this.button("Delete", async () => {
           if (!mayDelete(1)) return;
           await deleteJob(job);
           this.acts.gone(job);
         })]
      : this.button("Cancel", () => post(`/v1/jobs/${job.id}/cancel`)));
  }

  button(text, act) {
    const tell = (error) => {
      if (!error) return;
      this.progress.title = error.message; // it may be longer than its place
      fill(this.progress, error.message);
    };
    const { label, job } = this.job;
    return workButton([text, element("span", { class: "hidden-text" }, ` ${label ?? sceneName(job)}`)], act, tell);
  }
}

function parameters(job) {
  if (job.error) return job.error.detail;
  return job.words;
}

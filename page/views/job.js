/** One job: its state, and tabs with what it has computed so far. */

import { deleteJob, mayDelete, retriable, retryJob } from "../interface/acting.js";
import { workButton } from "../interface/button.js";
import { element, fill } from "../interface/element.js";
import { ago, withUnit } from "../interface/numbers.js";
import { ofParameters } from "../interface/form_address.js";
import { declaredFor, jobWords } from "../interface/job_words.js";
import { KINDS, kindsOfJobs } from "../interface/kinds_of_job.js";
import { address, go } from "../interface/route.js";
import { progressWords, sceneName, stateMark } from "../interface/state.js";
import { trouble } from "../interface/trouble.js";
import { whyQueued, workers } from "../interface/workers.js";
import { TERMINAL, follow } from "../requests/following.js";
import { untilAnswered } from "../requests/patiently.js";
import { Problem, get, pause, post } from "../requests/service.js";

const TABS = {
  watch: ["Watch", () => import("./job/watch.js"), ["history"]],
  diagram: ["Diagram", () => import("./job/diagram.js"), ["bifurcation"]],
  chart: ["Chart", () => import("./job/chart.js"), ["chart"]],
  attractors: ["Attractors", () => import("./job/shares.js"), ["attractors"]],
  branch: ["Branch", () => import("./job/branch.js"), ["branch"]],
  sweep: ["Sweep", () => import("./job/sweep.js"), ["sweep"]],
  sensitivity: ["Sensitivity", () => import("./job/sensitivity.js"), ["sensitivity"]],
  sections: ["Sections", () => import("./job/sections.js"), ["poincare"]],
  accuracy: ["Accuracy", () => import("./job/accuracy.js"), ["certificate", "accuracy"]],
  fit: ["Fit", () => import("./job/fit.js"), ["calibration"]],
  numbers: ["Numbers", () => import("./job/numbers.js"), ["peaks"]],
  figures: ["Figures", () => import("./job/figures.js"), ["figures"]],
  document: ["Document", () => import("./job/document.js"), ["self"]],
};
const AGAIN = 10000; // ms after which the time since the submission is told anew
const PATIENCE = 1500; // ms in the queue after which is asked who is there to compute

export async function show(room, { parts, query, signal }) {
  const [id, wanted] = parts;
  if (Object.hasOwn(TABS, wanted ?? "watch")) TABS[wanted ?? "watch"][1]().catch(() => {}); // its modules come along with the job
  const [job] = await Promise.all([
    get(`/v1/jobs/${encodeURIComponent(id ?? "")}`, {}, signal), kindsOfJobs(signal),
  ]);
  const tabs = Object.entries(TABS).filter(([name, [, , links]]) =>
    links.some((one) => job.links[one]) && !(name === "sections" && job.links.branch) // the branch shows them
    && !(name === "attractors" && job.links.chart)); // the chart does
  const tab = tabs.find(([name]) => name === wanted) ?? tabs[0];
  const name = job.label || sceneName(job.job).replaceAll("-", " ");
  document.title = `${name} · jointplay`;
  const head = new Head(job, name, signal);
  const content = element("div", {}, element("p", { class: "quiet" }, "Reading …"));
  fill(
    room,
    head.element,
    element(
      "nav",
      { class: "tabs", "aria-label": "Parts of the job" },
      tabs.map(([key, [title]]) => element("a", {
        href: address(["job", id, key]), "aria-current": key === tab[0] ? "page" : null,
      }, title)),
    ),
    content,
  );
  const listeners = new Set();
  const events = []; // of the history so far
  const hearers = new Set();
  const over = TERMINAL.has(job.state);
  if (!over) {
    follow(`/v1/jobs/${id}`, {
      signal,
      onEvent: (event) => {
        head.happened(event);
        events.push(event);
        for (const hear of hearers) hear(event);
      },
      onProgress: (now) => {
        Object.assign(job, now);
        head.refresh();
        for (const listener of listeners) listener(job);
        if (TERMINAL.has(job.state)) ended();
      },
      onLost: () => ended(),
    });
  }
  const ended = async () => {
    try {
      const ask = () => get(`/v1/jobs/${id}`, {}, signal);
      Object.assign(job, await untilAnswered(ask, signal));
    } catch (error) {
      if (error.name === "AbortError") return;
      if (!(error instanceof Problem)) throw error;
      fill(room, trouble(error, { view: "job", parts })); // it was deleted meanwhile
      return;
    }
    head.refresh();
    for (const listener of listeners) listener(job);
  };
  const { show: fillIn } = await tab[1][1]();
  await fillIn(content, { // `onEvent` hears from the one stream of this view, while there is one
    job, query, signal, onChange: (listener) => listeners.add(listener),
    onEvent: !over && ((hear) => {
      events.forEach(hear);
      hearers.add(hear);
    }),
  });
}

class Head {
  constructor(job, name, signal) {
    Object.assign(this, { job, signal });
    this.mark = element("span", { role: "status" });
    this.bar = element("progress", { max: 1, "aria-label": "Progress of the job" });
    this.words = element("p", { class: "quiet small" });
    this.when = element("span", { title: job.created });
    this.notice = element("div", { "aria-live": "polite" });
    this.buttons = element("div", { class: "buttons" });
    const kind = job.kind === "simulate" ? "" : ` · ${job.kind}`;
    this.element = element(
      "header",
      {},
      element("div", { class: "head" }, element("h1", {}, `${name}${kind}`), this.mark, this.buttons),
      this.facts(),
      this.notice,
      this.words,
      this.bar,
    );
    this.watchQueue().catch(() => {});
    this.tellWhen().catch(() => {}); // until the view is left
    this.refresh();
  }

  async tellWhen() {
    for (;;) {
      this.when.textContent = ago(this.job.created);
      await pause(AGAIN, this.signal);
    }
  }

  /** Shows, once there are results, what of the scene's start the run did not keep. */
  async showNotes() {
    const { notes } = await get(this.job.links.statistics, {}, this.signal);
    this.notes = notes.map((sentence) => element("p", {}, sentence));
    this.refresh();
  }

  /** Asks now and then, while the job is queued, who is there to compute it. */
  async watchQueue() {
    while (this.job.state === "queued") {
      await pause(PATIENCE, this.signal);
      if (this.job.state !== "queued") return;
      try {
        const usage = await get("/v1/usage", {}, this.signal);
        this.queued = whyQueued(await workers(this.signal), this.job.activity, usage);
      } catch {
        if (this.signal.aborted) return; // else it is asked again
      }
      this.refresh();
    }
  }

  facts() {
    const { job } = this;
    const fact = (title, value) => value &&
      element("div", {}, element("dt", {}, `${title}`), element("dd", {}, value));
    const parameters = element("div", { hidden: true });
    this.showParameters(parameters);
    return element(
      "dl",
      { class: "facts" },
      fact("Duration", job.job.duration && withUnit(job.job.duration, "s")),
      parameters,
      fact("Submitted", this.when),
      job.label && fact("Mechanism", sceneName(job.job).replaceAll("-", " ")),
      job.batch && element("div", {}, element("dt", {}, "Batch"), element("dd", {},
        element("a", { href: address(["batch", job.batch]) }, job.batch))),
      element("div", {}, element("dt", {}, "Id"), element("dd", {}, element("code", {}, job.id))),
    );
  }

  async showParameters(place) {
    const { duration, ...document } = this.job.job; // the duration is told beside
    const words = jobWords(document, await declaredFor(document));
    fill(place, element("dt", {}, "Values"), element("dd", {}, words));
    place.hidden = !words;
  }

  refresh() {
    const { job } = this;
    const over = TERMINAL.has(job.state);
    if (this.mark.textContent !== job.state) fill(this.mark, stateMark(job.state));
    this.words.textContent = progressWords(job);
    this.words.hidden = job.state === "succeeded";
    this.bar.hidden = over;
    if (job.state === "queued") this.bar.removeAttribute("value");
    else this.bar.value = job.progress.fraction;
    this.bar.dataset.fraction = String(job.progress.fraction);
    fill(this.notice, this.notices());
    if (this.shown !== over) this.showButtons((this.shown = over));
    if (over && job.links.statistics && !this.notes) {
      this.notes = [];
      this.showNotes().catch(() => {}); // a run that failed at once has none
    }
  }

  notices() {
    const { job } = this;
    const found = [];
    const box = (look, ...words) => found.push(element("div", { class: `notice ${look}` }, words));
    if (job.error) {
      const at = job.error.time === null ? "" : ` at ${withUnit(job.error.time, "s")}`;
      box("bad", element("p", {}, element("strong", {}, `It failed${at}: `), job.error.detail),
        element("p", { class: "small" }, REMEDIES[job.error.class]));
    }
    if (this.refused) box("bad", element("p", {}, this.refused));
    if (job.damaged) box("bad", element("p", {}, job.damaged));
    if (this.notes?.length) box("", this.notes);
    if (job.state === "queued" && this.queued) box("", this.queued);
    if (this.lost && !TERMINAL.has(job.state)) box("", element("p", {}, this.lost));
    if (job.attempt > 1) box("", element("p", {}, `This is attempt ${job.attempt}: the one before did not end, and this one went on from there.`));
    return found;
  }

  /** Shows an event of the job's history that readers want to see. */
  happened({ type, data }) {
    if (type === "lost") this.lost = `The worker ${data.worker} was lost; another goes on.`;
    if (type === "refused") this.lost = `Results of the worker ${data.worker} were refused (${data.reason}); they are computed anew.`;
  }

  showButtons(over) {
    const { job } = this;
    const button = (text, act) => workButton(text, act, (error) => {
      this.refused = error?.message ?? null; // until something is tried again
      this.refresh();
    });
    fill(
      this.buttons,
      over
        ? [
            retriable(job)
              ? button("Retry", async () => go(["job", (await retryJob(job)).id]))
              : button("Run again", async () => {
                  const again = await post("/v1/jobs", { ...job.job, cache: false });
                  go(["job", again.id]);
                }),
            changed(job),
            button("Delete", async () => {
              if (!mayDelete(1)) return;
              await deleteJob(job);
              go(["jobs"]);
            }),
          ]
        : button("Cancel", () => post(`/v1/jobs/${job.id}/cancel`)),
      job.kind === "simulate" &&
        element("a", { class: "button", href: address(["compare"], { jobs: job.id }) }, "Compare"),
    );
  }
}

/** Links to the form with this job's values, and to the editor with its scene. */
function changed(job) {
  const { scene, kind } = job.job;
  const given = Object.fromEntries(Object.entries(scene.preset ? scene.parameters ?? {} : {})
    .filter(([, value]) => value !== null));
  const query = { ...ofParameters(given), kind: kind === "simulate" ? null : kind, ...KINDS[kind]?.given(job.job), job: job.id };
  const link = (text, parts) => element("a", { class: "button", href: address(parts, query) }, text);
  const form = link("Run with changes", ["new", ...(scene.preset ? [scene.preset] : [])]);
  return scene.preset ? form : [form, link("Change the mechanism", ["editor"])];
}

const REMEDIES = {
  user: "Another document helps: change what the sentence names, and run it again.",
  solver: "Another tolerance or method may help: run it with changes, for example with accuracy fine.",
  platform: "This is no fault of the job: run it again, and tell who operates the service.",
  limit: "A smaller job helps: a shorter duration, fewer channels or points.",
};

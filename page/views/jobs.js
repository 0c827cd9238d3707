/** The list of jobs: filters in the address, as many rows as fit the screen, live. */

import {
  deletable, deleteJob, mayDelete, retriable, retryJob, withEach,
} from "../interface/acting.js";
import { workButton } from "../interface/button.js";
import { element, fill } from "../interface/element.js";
import { jobFilters } from "../interface/job_filters.js";
import { JobRow } from "../interface/job_row.js";
import { listed, renewed } from "../interface/listed.js";
import { address, note } from "../interface/route.js";
import { whyQueued, workers } from "../interface/workers.js";
import { trouble } from "../interface/trouble.js";
import { TERMINAL } from "../requests/following.js";
import { describedKinds } from "../requests/kinds.js";
import { get, mayPass, pause } from "../requests/service.js";

const FIRST_PAGE = 50; // more are asked for as soon as the list is scrolled
const PAGE = 200;
const NEWEST = 20; // jobs that are looked at again every second
const AHEAD = 200; // rows below what is seen that are asked for before they are scrolled to
const BEYOND = 8; // rows above and below what is seen
const MOST_COMPARED = 4;
const RARELY = 5; // of how many looks one is at those that are older, where they have all ended

export async function show(room, { query, signal }) {
  const kinds = Object.keys(await describedKinds(signal).catch(() => ({}))); // the list says what is wrong
  const list = new JobList(query, kinds, signal);
  fill(room, list.element);
  await list.begin();
}

class JobList {
  constructor(query, kinds, signal) {
    Object.assign(this, { signal, jobs: null, next: null, chosen: new Map(), rows: new Map() });
    this.looks = 0;
    this.deleted = new Set(); // ids, of which an answer may be on its way that is from before
    this.asked = new AbortController(); // for the newest list; answers to what was asked before are not taken
    signal.addEventListener("abort", () => this.asked.abort());
    this.filters = Object.fromEntries(["state", "kind", "scene", "label"].map((name) =>
      [name, query.get(name) ?? ""]));
    this.inside = element("div", { class: "inside", role: "list", "aria-label": "Jobs" });
    this.scroll = element("div", { class: "rows", tabindex: "0", role: "group",
      "aria-label": "List of jobs, scrolls", onscroll: () => this.scrolled() }, this.inside);
    this.empty = element("div");
    this.notice = element("div", { "aria-live": "polite" });
    this.problem = element("div", { "aria-live": "polite" });
    this.said = element("span", { role: "status", class: "quiet" });
    this.acts = element("span", { class: "buttons" });
    this.all = element("input", {
      type: "checkbox", id: "choose-all", onchange: () => this.chooseAll(this.all.checked),
    });
    this.element = element("div", {},
      element("div", { class: "head" }, element("h1", {}, "Jobs"), this.said,
        element("div", { class: "buttons" }, this.acts,
          element("a", { class: "button", href: "#/batches" }, "Batches"))),
      jobFilters(this.filters, kinds, (name, value) => this.filter(name, value),
        element("label", { class: "all", for: "choose-all" }, this.all, "All shown")),
      this.notice, this.problem, this.scroll, this.empty);
    new ResizeObserver(() => this.resized()).observe(this.scroll);
  }

  async filter(name, value) {
    this.filters[name] = value;
    note(this.filters);
    await this.load().catch((error) => this.failed(error));
  }

  async begin() {
    await this.load().catch((error) => {
      if (error.name !== "AbortError") throw error; // a filter was chosen before the first answer
    });
    this.live();
  }

  async load() {
    this.asked.abort();
    this.signal.throwIfAborted();
    const asked = (this.asked = this.pending = new AbortController());
    try {
      const page = await this.page(null, FIRST_PAGE);
      for (const row of this.rows.values()) row.element.remove();
      this.rows.clear();
      this.jobs = page.jobs;
      this.next = page.next;
      this.shown = asked;
    } finally {
      if (this.pending === asked) this.pending = null;
    }
    this.resized();
  }

  /** Whether the list is that of the filters as they are. */
  get current() {
    return this.shown === this.asked;
  }

  /** Returns a page of the list; throws AbortError where another list has been asked for meanwhile. */
  async page(token, size) {
    const { signal } = this.asked;
    const query = { ...this.filters, page_size: size, page_token: token };
    const { jobs, next_page_token: next } = await get("/v1/jobs", query, signal);
    const found = await Promise.all(jobs.map(listed));
    signal.throwIfAborted();
    return { jobs: found.filter(({ id }) => !this.deleted.has(id)), next };
  }

  /** Looks again, every second: new jobs, and those that are not finished. */
  async live() {
    while (!this.signal.aborted) {
      try {
        await pause(1000, this.signal);
        if (this.pending) continue; // another list
        if (this.current) await this.look();
        else await this.load(); // it was asked for, and did not come
      } catch (error) {
        if (error.name === "AbortError") continue; // another list has been asked for, or the view was left
        if (!mayPass(error)) return this.failed(error);
      }
    }
  }

  async look() {
    const newest = await this.page(null, NEWEST);
    const known = new Set(this.jobs.map(({ id }) => id));
    const apart = newest.jobs.every(({ id }) => !known.has(id));
    if (apart && newest.next !== null) await this.load(); // there may be more between
    else this.renew(newest, null);
    await this.lookBelow(newest.next);
    await this.tellWhy(newest.jobs.some(({ state }) => state === "queued"));
    this.draw();
  }

  /** Looks at the rows that are seen and older than the newest: they may be deleted by others, or have other states. */
  async lookBelow(newest) {
    const seen = this.jobs.slice(...this.range()).filter(({ id }) => newest !== null && id < newest);
    if (!seen.length) return;
    const moving = seen.some(({ state }) => !TERMINAL.has(state));
    if (!moving && (this.looks += 1) % RARELY) return;
    const after = this.jobs[this.jobs.indexOf(seen[0]) - 1]?.id ?? null;
    this.renew(await this.page(after, seen.length), after);
  }

  /** Takes a stretch of the list as it is now. */
  renew(page, after) {
    this.jobs = renewed(this.jobs, page, after, ({ id }) => this.chosen.delete(id));
    if (!this.jobs.length || page.next === null || this.jobs.at(-1).id >= page.next) this.next = page.next;
  }

  /** Says what to do where jobs are queued and nobody is there to compute them. */
  async tellWhy(waiting) {
    const alone = waiting && !(await workers(this.signal)).length;
    if (alone === this.alone) return;
    this.alone = alone;
    fill(this.notice, alone && element("div", { class: "notice" }, whyQueued([])));
  }

  failed(error) {
    if (error.name === "AbortError") return;
    this.drawn = null; // the next list takes its place
    fill(this.empty, trouble(error));
  }

  /** Measures once what would otherwise be asked of the browser's layout in every frame. */
  resized() {
    if (!this.jobs) return; // nothing has come yet
    this.scroll.hidden = !this.jobs.length;
    const rem = parseFloat(getComputedStyle(document.documentElement).fontSize);
    this.rowHeight = (matchMedia("(max-width: 760px)").matches ? 6 : 4) * rem;
    this.height = this.scroll.clientHeight;
    this.draw();
  }

  range() {
    const first = Math.floor(this.scroll.scrollTop / this.rowHeight) - BEYOND;
    const count = Math.ceil(this.height / this.rowHeight) + 2 * BEYOND;
    return [Math.max(0, first), Math.max(0, first) + count];
  }

  async scrolled() {
    this.draw();
    const [, last] = this.range();
    if (last + AHEAD < this.jobs.length || !this.next || this.loading || !this.current) return;
    this.loading = true;
    try {
      const page = await this.page(this.next, PAGE);
      const last = this.jobs.at(-1)?.id ?? null; // a look meanwhile may have come further
      this.jobs.push(...page.jobs.filter(({ id }) => last === null || id < last));
      this.next = page.next;
      this.draw();
    } catch (error) {
      if (error.name !== "AbortError" && !mayPass(error)) this.failed(error);
    } finally {
      this.loading = false;
    }
  }

  draw() {
    const [first, last] = this.range();
    this.count();
    this.showActs();
    const shown = this.jobs.slice(first, last);
    const ids = new Set(shown.map(({ id }) => id));
    for (const [id, row] of this.rows) {
      if (ids.has(id)) continue;
      row.element.remove();
      this.rows.delete(id);
    }
    shown.forEach((job, place) => {
      let row = this.rows.get(job.id);
      if (!row) {
        row = new JobRow(job, {
          choose: (one, chosen) => this.choose(one, chosen),
          gone: (one) => this.gone([one]),
          chosen: this.chosen.has(job.id),
        });
        this.rows.set(job.id, row);
        this.inside.append(row.element);
      }
      row.update(job, (first + place) * this.rowHeight);
    });
  }

  get filtered() {
    return Object.values(this.filters).some(Boolean);
  }

  nothing() {
    const { filtered } = this;
    return element("div", { class: "panel" },
      element("h2", {}, filtered ? "No job matches these filters" : "No jobs yet"),
      filtered
        ? element("a", { class: "button", href: "#/jobs" }, "Show all jobs")
        : element("p", {}, "Choose a ", element("a", { href: "#/" }, "mechanism"),
          " and run it: its job appears here."));
  }

  /** Says how many there are, once they are more or fewer. */
  count() {
    const said = `${this.jobs.length}${this.next ? "+" : ""} shown`;
    const drawn = `${said} ${this.rowHeight} ${this.filtered}`;
    if (this.drawn === drawn) return;
    this.drawn = drawn;
    this.said.textContent = said;
    this.inside.style.height = `${Math.max(this.jobs.length * this.rowHeight, 1)}px`;
    this.scroll.hidden = !this.jobs.length;
    fill(this.empty, this.jobs.length ? null : this.nothing());
  }

  choose(job, chosen) {
    if (chosen) this.chosen.set(job.id, job);
    else this.chosen.delete(job.id);
    this.showActs();
  }

  /** Chooses all that are listed, or none. */
  chooseAll(chosen) {
    this.chosen = new Map(chosen ? this.jobs.map((job) => [job.id, job]) : []);
    for (const [id, row] of this.rows) row.box.checked = this.chosen.has(id);
    this.showActs();
  }

  /** Shows what can be done with the chosen jobs, with how many of them. */
  showActs() {
    for (const job of this.jobs) if (this.chosen.has(job.id)) this.chosen.set(job.id, job);
    const jobs = [...this.chosen.values()];
    const runs = jobs.every(({ kind }) => kind === "simulate");
    const [ended, failed] = [jobs.filter(deletable), jobs.filter(retriable)];
    const now = [...jobs.map(({ id }) => id), ended.length, failed.length].join();
    if (now === this.offered) return;
    this.offered = now;
    this.all.checked = jobs.length > 0 && this.jobs.every(({ id }) => this.chosen.has(id));
    const tell = (error) => fill(this.problem, error && element("div", { class: "notice bad" }, error.message));
    const button = (text, act) => workButton(text, act, tell);
    fill(this.acts,
      runs && jobs.length > 1 && jobs.length <= MOST_COMPARED && element("a", {
        class: "button", href: address(["compare"], { jobs: [...this.chosen.keys()].join(",") }),
      }, `Compare ${jobs.length}`),
      failed.length > 0 && button(`Retry ${failed.length}`, () => withEach(failed, retryJob, "retried", () => {})),
      ended.length > 0 && button(`Delete ${ended.length}`, () => mayDelete(ended.length)
        && withEach(ended, deleteJob, "deleted", (jobs) => this.gone(jobs))));
  }

  gone(jobs) {
    const ids = new Set(jobs.map(({ id }) => id));
    for (const id of ids) this.deleted.add(id);
    this.jobs = this.jobs.filter(({ id }) => !ids.has(id));
    for (const id of ids) this.chosen.delete(id);
    this.draw();
  }
}

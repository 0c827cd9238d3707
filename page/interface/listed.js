/** A job as a list keeps it: ten thousand of them are some megabytes. */

import { declaredFor, jobWords } from "./job_words.js";

/** Returns what a row shows of a job, without its document. */
export async function listed(job) {
  const { scene, duration } = job.job;
  const words = jobWords(job.job, await declaredFor(job.job));
  const { id, kind, label, state, activity, progress, created, started, finished, error } = job;
  return {
    id, kind, label, state, activity, progress, created, started, finished, error, words,
    job: { kind, duration, scene: { preset: scene?.preset, name: scene?.name } },
  };
}

/**
 * Returns a list of jobs, the newest first, with a stretch of it as it is now.  Jobs of the stretch that are no longer
 * there are left out: others deleted them, or they are not what the filters ask for any more.
 *
 * @param page `{jobs, next}`: the stretch, and the id of its last job if there are more behind it
 * @param after the id of the job before the stretch; null: it begins with the newest
 * @param gone called with each job that is left out
 */
export function renewed(list, { jobs, next }, after, gone) {
  const now = new Set(jobs.map(({ id }) => id));
  const before = list.filter(({ id }) => after !== null && id >= after);
  const behind = list.filter(({ id }) => next !== null && id < next);
  list.slice(before.length, list.length - behind.length).filter(({ id }) => !now.has(id)).forEach(gone);
  return [...before, ...jobs, ...behind];
}

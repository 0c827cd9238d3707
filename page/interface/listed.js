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
 * Returns the jobs of a list without those that are no longer among its newest, though as new: deleted by others, or
 * not what the filters ask for.
 *
 * @param newest jobs of the list now, the newest first; next: whether there are more behind them
 * @param gone called with each job that is left out
 */
export function stillListed(jobs, newest, next, gone) {
  const ids = new Set(newest.map(({ id }) => id));
  const oldest = jobs.findLastIndex(({ id }) => ids.has(id));
  const isGone = ({ id }, place) => !ids.has(id) && (place < oldest || !next);
  jobs.filter(isGone).forEach(gone);
  return jobs.filter((job, place) => !isGone(job, place));
}

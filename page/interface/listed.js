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

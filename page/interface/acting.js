/** What is done with jobs, one or many of them: one question, and one sentence on what failed. */

import { TERMINAL } from "../requests/following.js";
import { post, remove } from "../requests/service.js";

const AT_ONCE = 6; // requests
const RETRIABLE = new Set(["failed", "cancelled"]);

/** Whether a job failed or was cancelled, so that it can be retried. */
export function retriable({ state }) {
  return RETRIABLE.has(state);
}

/** Whether a job has ended, so that it can be deleted. */
export function deletable({ state }) {
  return TERMINAL.has(state);
}

/** Asks before jobs are deleted; returns whether they may be. */
export function mayDelete(count) {
  return confirm(count === 1
    ? "Delete this job and its results?"
    : `Delete these ${count} jobs and their results?`);
}

/** Deletes a job. */
export function deleteJob({ id }) {
  return remove(`/v1/jobs/${id}`);
}

/** Queues a job anew; returns the new one. */
export function retryJob({ id }) {
  return post(`/v1/jobs/${id}/retry`);
}

/**
 * Does something with each of many jobs.
 *
 * @param ended called with those with which it was done, whether it was done with all or not
 * @throws {Error} says of how many it was not done, and why
 */
export async function withEach(jobs, act, word, ended) {
  const waiting = [...jobs];
  const done = [];
  const failures = [];
  const one = async () => {
    for (let job = waiting.shift(); job; job = waiting.shift()) {
      try {
        await act(job);
        done.push(job);
      } catch (error) {
        failures.push(error.message);
      }
    }
  };
  await Promise.all(Array.from({ length: AT_ONCE }, one));
  ended(done);
  if (failures.length) throw new Error(`${failures.length} of ${jobs.length} could not be ${word}: ${failures[0]}`);
}

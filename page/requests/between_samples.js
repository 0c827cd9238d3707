/** Whether a run kept what is between its samples. */

import { get } from "./service.js";

const COMPUTED = new Set(["steps", "motion"]); // from these, values at any time
const END = 0.01; // share of a window that is looked at

/**
 * Returns whether a channel can be had at any time of a window, not at samples alone.
 *
 * A run keeps steps from its beginning on: where the end of a window has them, all of it has. (Extremes
 * are exact without steps, too, but values between samples are not known then.)
 *
 * @param job a job of kind `simulate`, as the service shows it
 * @param window `[start, stop]` in s
 */
export async function betweenSamples(job, channel, [start, stop], signal) {
  const end = Math.max(END * (stop - start), 2 * job.job.output_step); // more than is on its way to the store
  const query = { channels: channel, start: Math.max(start, stop - end), stop, points: 1 };
  const { resolution } = await get(job.links.history, query, signal);
  return COMPUTED.has(resolution?.basis);
}

/** Workers of the service: who is alive, and what to do where nobody is. */

import { element } from "./element.js";
import { tableOf } from "./table.js";
import { get } from "../requests/service.js";

/** Returns the workers that are alive, as the service lists them. */
export async function workers(signal) {
  return (await get("/v1/workers", {}, signal)).workers;
}

/** Returns the machine and the process that a worker's name tells: "host:1234". */
export function processOf(name) {
  return name.split(":").slice(0, 2).join(":");
}

/**
 * Returns a sentence, or more, on why a queued job waits.
 *
 * @param activity what is known of it: null, or that no worker has its solver
 * @param usage of the owner of the page's key, as `/v1/usage` tells it
 */
export function whyQueued(alive, activity = null, usage = {}) {
  const busy = alive.filter(({ blocks }) => blocks.length).length;
  if (!alive.length) {
    return [
      element("p", {}, element("strong", {}, "No worker is alive: "), "nothing is computed until one is."),
      element("p", { class: "small" }, element("code", {}, "jointplay serve"), " starts the service with its"
        + " workers; further ones join it with ", element("code", {},
        `jointplay worker --join ${location.origin} --key-file FILE`),
        ". The jobs stay where they are and begin as soon as there is a worker."),
    ];
  }
  if (busy === alive.length) {
    return [element("p", {}, `All ${alive.length} workers are busy with other jobs; this one is waiting for its turn.`)];
  }
  const idle = `${alive.length - busy} of ${alive.length} workers ${alive.length - busy === 1 ? "has" : "have"} nothing to do`;
  return [element("p", {}, `${idle}${whyNotYet(activity, usage)}`)];
}

/** Returns the end of a sentence on workers that have nothing to do, and a job that waits. */
function whyNotYet(activity, { running_blocks: running, most_running_blocks: most }) {
  if (activity) return `, but this one waits: ${activity}.`;
  if (!most) return ": this begins in a moment.";
  const limit = `${most === 1 ? "one block" : `${most} blocks`} of each owner may be computed at one time`;
  return running < most
    ? `: this begins in a moment, unless its owner has as many blocks computed as one may: ${limit}.`
    : `, but ${limit}: this begins when one of yours ends.`;
}

/** Returns a table of the blocks of a job that workers have, or null. */
export function atWork(alive, job) {
  const rows = alive.flatMap(({ name, processor, device, blocks }) => blocks
    .filter((one) => one.job === job)
    .map(({ block, attempt, since }) => element("tr", {},
      element("td", { class: "small", title: name }, processOf(name)),
      element("td", { class: "small" }, device ?? processor),
      element("td", {}, String(block)),
      element("td", {}, String(attempt)),
      element("td", {}, new Date(since).toLocaleTimeString([], { hour12: false })))));
  return rows.length ? tableOf("Who computes it", ["Worker", "Processor", "Block", "Attempt", "Since"], rows) : null;
}

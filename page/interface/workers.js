/** Workers of the service: who is alive, and what to do where nobody is. */

import { element } from "./element.js";
import { get } from "../requests/service.js";

/** Returns the workers that are alive, as the service lists them. */
export async function workers(signal) {
  return (await get("/v1/workers", {}, signal)).workers;
}

/** Returns the machine and the process that a worker's name tells: "host:1234". */
export function processOf(name) {
  return name.split(":").slice(0, 2).join(":");
}

/** Returns a sentence, or more, on why queued jobs wait. */
export function whyQueued(alive) {
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
  return [element("p", {}, busy < alive.length
    ? `${alive.length - busy} of ${alive.length} workers ${alive.length - busy === 1 ? "has" : "have"} nothing to do: this begins in a moment.`
    : `All ${alive.length} workers are busy with other jobs; this one is waiting for its turn.`)];
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
  return rows.length ? element("table", {},
    element("thead", {}, element("tr", {}, ["Worker", "Processor", "Block", "Attempt", "Since"]
      .map((title) => element("th", { scope: "col" }, title)))),
    element("tbody", {}, rows)) : null;
}

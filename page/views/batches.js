/** The batches of the service, the newest first: how many of their jobs are in each state. */

import { element, fill, refill } from "../interface/element.js";
import { ago } from "../interface/numbers.js";
import { address } from "../interface/route.js";
import { stateMark } from "../interface/state.js";
import { tableOf } from "../interface/table.js";
import { get, mayPass, pause } from "../requests/service.js";

const SHOWN = 100;

export async function show(room, { signal }) {
  const content = element("section", { class: "panel" });
  fill(room, element("div", { class: "head" }, element("h1", {}, "Batches"),
    element("div", { class: "buttons" }, element("a", { class: "button", href: "#/jobs" }, "All jobs"))),
  content);
  for (;;) {
    try {
      const { batches, next_page_token: more } = await get("/v1/batches", { page_size: SHOWN }, signal);
      refill(content, batches.length ? table(batches) : element("p", {}, "No batches yet: a POST of"
        + " /v1/batches, or client.submit_batch, submits many jobs together."),
      more && element("p", { class: "quiet small" }, `The newest ${SHOWN} are shown.`));
    } catch (error) {
      if (!mayPass(error) || !content.childElementCount) throw error;
    }
    await pause(2000, signal);
  }
}

function table(batches) {
  return tableOf("Batches", ["Batch", "Jobs", "States", "Progress", "Submitted"], batches.map(row), "roomy");
}

function row({ id, label, jobs, states, progress, created }) {
  return element("tr", {},
    element("th", { scope: "row" }, element("a", { href: address(["batch", id]) }, label || id)),
    element("td", {}, String(jobs)),
    element("td", {}, counts(states)),
    element("td", {}, element("progress", { max: 1, value: progress.fraction, "aria-label": "Progress" })),
    element("td", { title: created }, ago(created)));
}

/** Returns marks of the states that jobs are in, each with their number. */
export function counts(states) {
  return Object.entries(states).filter(([, count]) => count)
    .map(([state, count]) => [stateMark(state), ` ${count}  `]);
}

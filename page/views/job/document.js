/** A job's document, what happened to it, and how to submit it again. */

import { element, fill } from "../../interface/element.js";
import { jobAsText } from "../../interface/job_as_text.js";
import { tableOf } from "../../interface/table.js";
import { atWork, processOf, workers } from "../../interface/workers.js";
import { TERMINAL, follow } from "../../requests/following.js";

export async function show(room, { job, signal, onChange, onEvent }) {
  const happened = tableOf("What happened", ["When", "What", "Details"], []);
  const rows = happened.querySelector("tbody");
  const working = element("div");
  let asking = false;
  const tellWho = async ({ state }) => {
    if (asking) return;
    asking = true;
    const found = TERMINAL.has(state) ? null : atWork(await workers(signal), job.id);
    fill(working, found && [element("h2", {}, "Who computes it"), found]);
    asking = false;
  };
  fill(
    room,
    element(
      "div",
      { class: "split" },
      element("section", { class: "panel" }, element("h2", {}, "The same job elsewhere"),
        element("p", { class: "quiet small" }, "With every default filled in: it repeats the"
          + " results bit for bit."),
        jobAsText(() => job.job).element),
      element("section", { class: "panel" }, working, element("h2", {}, "What happened"),
        happened,
        element("p", { class: "quiet small" }, `Solver ${job.solver_version}`)),
    ),
  );
  const hear = ({ type, time, data }) => rows.append(element("tr", {},
    element("td", { class: "when", title: time }, new Date(time).toLocaleTimeString([], { hour12: false })),
    element("td", {}, type),
    element("td", { class: "small", title: details(data) }, details({ ...data, ...inShort(data) }))));
  if (!onEvent) return void follow(`/v1/jobs/${job.id}`, { signal, onEvent: hear }); // it has ended
  onEvent(hear);
  const told = (now) => tellWho(now).catch(() => (asking = false));
  onChange(told);
  told(job);
}

/** Returns a block without its job's id, and a worker as its machine and process. */
function inShort({ block, worker }) {
  return {
    ...(typeof block === "string" ? { block: block.split("-").at(-1) } : {}),
    ...(worker ? { worker: processOf(worker) } : {}),
  };
}

function details(data) {
  return Object.entries(data)
    .map(([name, value]) => `${name}: ${typeof value === "object" ? JSON.stringify(value) : value}`)
    .join(", ");
}

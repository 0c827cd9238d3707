/** A batch: how many of its jobs are in each state, and the jobs in the order of the request. */

import { element, fill } from "../interface/element.js";
import { address } from "../interface/place.js";
import { sceneName, stateMark } from "../interface/state.js";
import { Unreachable, get, pause, post } from "../requests/service.js";

const SHOWN = 200;

export async function show(room, { parts, signal }) {
  const path = `/v1/batches/${encodeURIComponent(parts[0] ?? "")}`;
  for (;;) {
    try {
      const batch = await get(path, {}, signal);
      const { jobs } = await get(`${path}/jobs`, { page_size: SHOWN }, signal);
      draw(room, batch, jobs, path);
      if (jobs.every(({ finished }) => finished)) return;
    } catch (error) {
      if (!(error instanceof Unreachable) || !room.childElementCount) throw error;
    }
    await pause(1500, signal);
  }
}

function draw(room, batch, jobs, path) {
  const moving = jobs.some(({ finished }) => !finished);
  fill(
    room,
    element("div", { class: "head" }, element("h1", {}, batch.label || "Batch"),
      moving && element("div", { class: "buttons" },
        element("button", { type: "button", onclick: () => post(`${path}/cancel`) }, "Cancel all"))),
    element("p", {}, Object.entries(batch.states ?? {}).filter(([, count]) => count)
      .map(([state, count]) => [stateMark(state), ` ${count}  `])),
    element("section", { class: "panel" }, element("table", {},
      element("thead", {}, element("tr", {}, ["Job", "State", "Progress"].map((title) =>
        element("th", { scope: "col" }, title)))),
      element("tbody", {}, jobs.map((job) => element("tr", {},
        element("td", {}, element("a", { href: address(["job", job.id]) }, job.label || sceneName(job.job))),
        element("td", {}, stateMark(job.state)),
        element("td", {}, element("progress", {
          max: 1, value: job.progress.fraction, "aria-label": "Progress",
        }))))))),
  );
}

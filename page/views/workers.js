/** The workers of the service: since when each is there, and what it computes. */

import { element, fill, refill } from "../interface/element.js";
import { ago, span } from "../interface/numbers.js";
import { address } from "../interface/route.js";
import { tableOf } from "../interface/table.js";
import { processOf, whyQueued, workers } from "../interface/workers.js";
import { mayPass, pause } from "../requests/service.js";

const AGAIN = 2000; // ms

export async function show(room, { signal }) {
  const said = element("span", { role: "status", class: "quiet" });
  const content = element("section", { class: "panel" });
  fill(room, element("div", { class: "head" }, element("h1", {}, "Workers"), said), content);
  for (;;) {
    try {
      const alive = await workers(signal);
      said.textContent = alive.length === 1 ? "1 is alive" : `${alive.length} are alive`;
      refill(content, alive.length ? table(alive) : whyQueued(alive));
    } catch (error) {
      if (!mayPass(error) || !content.childElementCount) throw error;
    }
    await pause(AGAIN, signal);
  }
}

function table(alive) {
  const titles = ["Worker", "What it computes", "Since", "Heard of", "Processor", "Solver"];
  return tableOf("Workers", titles, alive.map(row), "roomy");
}

function row({ name, since, seen, blocks, processor, device, version }) {
  return element("tr", {},
    element("th", { scope: "row", title: name }, processOf(name)),
    element("td", {}, blocks.length ? blocks.map(held) : element("span", { class: "quiet" }, "nothing")),
    element("td", { title: since }, since ? ago(since) : "–"),
    element("td", { title: seen }, ago(seen)),
    element("td", { class: "small" }, device ?? processor),
    element("td", { class: "small" }, element("code", {}, version)));
}

/** Says what a worker has: a block of a job, which is a link unless it is another owner's. */
function held({ job, block, attempt, since }) {
  const took = span((Date.now() - Date.parse(since)) / 1000);
  const words = `block ${block}${attempt > 1 ? `, attempt ${attempt}` : ""}, for ${took}`;
  return element("div", {}, job === null ? "another owner's job: " : [
    element("a", { href: address(["job", job, "document"]) }, element("code", {}, job)), ": ",
  ], words);
}

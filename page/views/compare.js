/** Up to four runs in the same plots, and their mechanisms in one picture. */

import { ChannelChoice } from "../interface/channel_choice.js";
import { element, fill } from "../interface/element.js";
import { declaredFor, differing } from "../interface/job_words.js";
import { address, go, note } from "../interface/route.js";
import { drawnSceneOf } from "../interface/scene_of_job.js";
import { sceneName } from "../interface/state.js";
import { Clock } from "../mechanism/clock.js";
import { Motion } from "../mechanism/motion.js";
import { onNewColours } from "../mechanism/palette.js";
import { player, watchable } from "../mechanism/player.js";
import { calm } from "../mechanism/sketch.js";
import { Stage } from "../mechanism/stage.js";
import { turn } from "../mechanism/turn.js";
import { HistoryPlots } from "../plots/history_plots.js";
import { jobIfThere } from "../requests/jobs.js";
import { get } from "../requests/service.js";

const MOST = 4;

export async function show(room, { query, signal }) {
  const wanted = (query.get("jobs") ?? "").split(",").filter(Boolean).slice(0, MOST);
  const found = await Promise.all(wanted.map((id) => jobIfThere(id, signal)));
  const jobs = found.filter(Boolean);
  const gone = wanted.filter((_, i) => !found[i]);
  const ids = wanted.filter((_, i) => found[i]);
  const others = await candidates(ids, signal);
  const words = jobs.length ? differing(jobs, await declaredFor(jobs[0].job)) : [];
  const head = [
    element("h1", {}, "Compared jobs"),
    gone.map((id) => element("p", { class: "notice" }, "The job ", element("code", {}, id), " is gone.")),
    element("ul", { class: "legend" }, jobs.map((job, i) => entry(job, i, ids, words[i]))),
    ids.length < MOST && adding(ids, others),
  ];
  if (!jobs.length) {
    fill(room, head, element("p", { class: "panel" }, "Choose jobs above, or mark them in the list of jobs."));
    return;
  }
  const scenes = await Promise.all(jobs.map((job) => drawnSceneOf(job.job, signal)));
  const clock = new Clock(0, Math.max(...jobs.map((job) => job.progress.time), 1e-9));
  clock.speed = watchable(Math.min(turn(scenes[0]) ?? Infinity, clock.last));
  const draw = () => stage.draw(clock.time);
  const motions = jobs.map((job, i) => new Motion(job, scenes[i], draw, signal))
    .filter(({ missing }) => !missing.length);
  const stage = new Stage(motions, "of each job");
  const plots = new HistoryPlots(jobs, clock, signal, ([from, to]) => note({ from, to }));
  const stored = [...new Set(jobs.flatMap(({ job }) => job.channels))];
  const choice = new ChannelChoice(stored, likely(query, stored, scenes), (names) => {
    note({ channels: names.join(",") });
    plots.show(names);
  });
  fill(
    room,
    head,
    element("div", { class: "split even" },
      element("section", { class: "panel stays", "aria-label": "Mechanisms" },
        element("div", { class: "stage" }, stage.canvas), player(clock)),
      element("section", { class: "panel" }, element("h2", {}, "History"), plots.element, choice.element)),
  );
  clock.listen(draw);
  onNewColours(draw, signal);
  addEventListener("resize", draw, { signal });
  signal.addEventListener("abort", () => clock.stop());
  draw();
  if (!calm()) clock.play();
  await plots.show(choice.names);
}

function entry(job, i, ids, words) {
  const rest = ids.filter((id) => id !== job.id);
  return element("li", {}, element("span", { class: `swatch swatch-${i}` }),
    element("a", { href: address(["job", job.id]) }, job.label || sceneName(job.job).replaceAll("-", " ")),
    words && element("span", { class: "quiet" }, words), " ",
    element("a", { href: address(["compare"], { jobs: rest.join(",") }), "aria-label": `Leave out ${job.id}` }, "✕"));
}

async function candidates(ids, signal) {
  const { jobs } = await get("/v1/jobs", { kind: "simulate", state: "succeeded", page_size: 50 }, signal);
  return jobs.filter(({ id }) => !ids.includes(id));
}

function adding(ids, others) {
  const select = element("select", { id: "add", onchange: () =>
    select.value && go(["compare"], { jobs: [...ids, select.value].join(",") }) },
  element("option", { value: "" }, "choose …"),
  others.map((job) => element("option", { value: job.id },
    `${job.label || sceneName(job.job)} · ${new Date(job.created).toLocaleString()}`)));
  return element("div", { class: "filters" }, element("div", { class: "field" },
    element("label", { for: "add" }, "Add a finished run"), select));
}

function likely(query, stored, scenes) {
  const asked = (query.get("channels") ?? "").split(",").filter((name) => stored.includes(name));
  if (asked.length) return asked;
  const outputs = scenes.flatMap((scene) => (scene.outputs ?? []).map(({ name }) => name));
  const forces = stored.filter((name) => name.endsWith(".normal_force"));
  const names = [...outputs.filter((name) => stored.includes(name)), ...forces];
  return [...new Set(names.length ? names : stored)].slice(0, 4);
}

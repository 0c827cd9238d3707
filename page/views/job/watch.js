/** A run to watch: the mechanism in motion, its clearance joints magnified, its histories. */

import { ChannelChoice } from "../../interface/channel_choice.js";
import { gaps, spansInWords } from "../../interface/converged.js";
import { historyAsCsv } from "../../interface/csv.js";
import { element, fill } from "../../interface/element.js";
import { saving } from "../../interface/saving.js";
import { note } from "../../interface/route.js";
import { drawnSceneOf } from "../../interface/scene_of_job.js";
import { Clock } from "../../mechanism/clock.js";
import { Insets } from "../../mechanism/insets.js";
import { Motion } from "../../mechanism/motion.js";
import { onNewColours } from "../../mechanism/palette.js";
import { player, watchable } from "../../mechanism/player.js";
import { calm } from "../../mechanism/sketch.js";
import { Stage } from "../../mechanism/stage.js";
import { turn } from "../../mechanism/turn.js";
import { contacts } from "../../requests/contacts.js";
import { TERMINAL } from "../../requests/following.js";
import { Newest } from "../../requests/newest.js";
import { get } from "../../requests/service.js";
import { PhasePortrait, Spectrum } from "./window.js";

export async function show(room, context) {
  const { job, onChange } = context;
  if (job.state === "queued" || (job.state === "running" && !job.progress.time)) {
    fill(room, element("p", { class: "panel" }, "Nothing is computed yet. The mechanism moves here"
      + " as soon as its first seconds are."));
    await new Promise((resolve) => onChange(({ state, progress }) => {
      if (TERMINAL.has(state) || progress.time > 0) resolve();
    }));
  }
  if (context.signal.aborted) return;
  await new Watch(room, context).begin();
}

class Watch {
  constructor(room, { job, query, signal, onChange }) {
    Object.assign(this, { room, job, query, signal, onChange });
  }

  async begin() {
    const { job, query, signal } = this;
    const scene = await drawnSceneOf(job.job, signal);
    this.clock = new Clock(0, TERMINAL.has(job.state) && !job.error && job.state === "succeeded"
      ? job.job.duration : Math.max(job.progress.time, 1e-9));
    this.clock.speed = watchable(Math.min(turn(scene) ?? Infinity, job.job.duration));
    this.motion = new Motion(job, scene, () => this.draw(), signal);
    this.stage = new Stage([this.motion], job.label || scene.name);
    this.insets = new Insets(this.motion);
    this.impacts = [];
    this.facts = new Newest(() => this.showFacts());
    const plotRoom = element("section", { class: "panel" }, element("h2", {}, "History"));
    this.looks = [PhasePortrait, Spectrum].map((Look) => new Look(job, query, signal));
    fill(this.room,
      element("div", { class: "stacked" },
        element("div", { class: "split even" }, this.drawing(scene), plotRoom),
        element("div", { class: "looks" }, this.looks.map((look) => look.element))));
    onNewColours(() => this.draw(), signal);
    addEventListener("resize", () => this.draw(), { signal });
    signal.addEventListener("abort", () => this.clock.stop());
    this.clock.listen(() => this.draw());
    this.clock.seek(Number(query.get("t") ?? 0));
    this.listen();
    if (!calm() && !query.has("t")) this.clock.play();
    if (!this.motion.missing.length) {
      await this.motion.ready(this.clock.time).catch(() => {}); // what is asked besides would delay it
    }
    if (!signal.aborted) await Promise.all([this.plots(plotRoom, scene), this.facts.want()]);
  }

  drawing(scene) {
    const { motion, stage, clock } = this;
    if (motion.missing.length) {
      return element("section", { class: "panel" }, element("h2", {}, "Mechanism"),
        element("p", {}, "This job did not store where its bodies are"
          + ` (${motion.missing.map((body) => `${body}.x, .y, .theta`).join("; ")}), so it cannot`
          + " be drawn. Run it with these channels to see it move."));
    }
    const labels = element("input", { type: "checkbox", id: "labels", onchange: () => {
      stage.labels = labels.checked;
      this.draw();
    } });
    return element(
      "section",
      { class: "panel stays", "aria-label": "Mechanism" },
      element("div", { class: "stage" }, stage.canvas),
      player(clock, () => this.impacts),
      element("div", { class: "buttons" },
        element("label", { class: "buttons small", for: "labels" }, labels, "Names"),
        saving({ stage, clock, insets: this.insets, impacts: () => this.impacts, name: scene.name })),
      this.insets.joints.length > 0 && this.insets.element,
    );
  }

  draw() {
    if (this.motion.missing.length) return;
    const { time } = this.clock;
    const [state] = this.stage.draw(time);
    if (state) this.insets.draw(time, state);
  }

  async plots(room, scene) {
    const { HistoryPlots } = await import("../../plots/history_plots.js");
    const { job, query } = this;
    this.history = new HistoryPlots([job], this.clock, this.signal, ([from, to]) => {
      note({ from, to });
      this.follow();
    });
    this.history.onsets = this.impacts;
    const choice = new ChannelChoice(job.job.channels, chosen(query, job, scene), (names) => {
      note({ channels: names.join(",") });
      this.history.show(names).then(() => this.certify());
    });
    this.marks = element("ul", { class: "legend" });
    room.append(this.history.element, this.marks,
      historyAsCsv(job, () => this.history, this.signal), choice.element);
    if (query.has("from") && query.has("to")) {
      this.history.window = [Number(query.get("from")), Number(query.get("to"))];
    }
    this.follow();
    await this.history.show(choice.names);
    await this.certify();
  }

  /** Shows the same window otherwise. */
  follow() {
    for (const look of this.looks) look.follow(this.history.window);
  }

  /** What is drawn besides, as far as it is there: peaks and impacts. */
  async showFacts() {
    const { links, job } = this.job;
    const none = () => null;
    const [peaks, found] = await Promise.all([
      links.peaks && get(links.peaks, {}, this.signal).catch(none),
      links.impacts && contacts(links.impacts, job.duration, this.signal).catch(none),
    ]);
    this.insets.peaks = peaks?.peaks ?? {};
    this.impacts = (found?.impacts ?? []).map(({ onset }) => onset).sort((a, b) => a - b);
    this.history?.mark({ onsets: this.impacts });
    if (this.marks) this.explain(this.history.certificate);
    this.clock.tell();
  }

  /** Shows how far the curves hold that are shown, once that is known. */
  async certify() {
    const { links, state, job } = this.job;
    const names = this.history.channels.join(",");
    if (!links.certificate || job.certificate === false || !TERMINAL.has(state)) return;
    const found = await get(links.certificate, { channels: names }, this.signal).catch(() => null);
    if (names !== this.history.channels.join(",")) return; // others are shown meanwhile
    this.history.mark({ certificate: found });
    this.explain(found);
  }

  /** Says what the marks in the plots mean. */
  explain(certificate) {
    const apart = certificate ? gaps(certificate, 0, this.clock.last) : [];
    const beyond = apart.length > 0;
    const entry = (look, words) => element("li", {}, element("span", { class: `swatch ${look}` }), words);
    fill(this.marks,
      this.impacts.length > 0 && entry("swatch-impact", "a contact begins"),
      beyond && entry("swatch-beyond", `not converged, ${spansInWords(apart)}: other tolerances take other paths`),
      beyond && entry("swatch-spread", "where their extremes lie"));
  }

  /** Shows what a running job has computed meanwhile. */
  listen() {
    this.onChange((job) => {
      const over = TERMINAL.has(job.state);
      const reached = job.state === "succeeded" ? job.job.duration : job.progress.time;
      this.motion.refresh();
      this.clock.extend(Math.max(reached, this.clock.last));
      this.history?.extend(this.clock.last);
      if (!over) return;
      this.facts.want();
      if (this.history?.channels) this.certify();
    });
  }
}

function chosen(query, job, scene) {
  const stored = new Set(job.job.channels);
  const asked = (query.get("channels") ?? "").split(",").filter((name) => stored.has(name));
  if (asked.length) return asked;
  const outputs = (scene.outputs ?? []).map(({ name }) => name);
  const forces = job.job.channels.filter((name) => name.endsWith(".normal_force"));
  const likely = [...outputs, ...forces].filter((name) => stored.has(name));
  const some = likely.length ? likely : job.job.channels;
  return some.slice(0, 5);
}

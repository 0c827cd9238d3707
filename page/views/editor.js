/** A mechanism of one's own: its document, its drawing as it is typed, what is wrong, and a run. */

import { help } from "../editor/help.js";
import { fieldList } from "../editor/field_list.js";
import { sceneFiles } from "../editor/files.js";
import { FreeMotion } from "../editor/free_motion.js";
import { SceneSchema } from "../editor/schema.js";
import { startedIn } from "../editor/start_here.js";
import { FIRST_SCENE } from "../editor/first_scene.js";
import { keep, kept } from "../editor/kept.js";
import { TextEditor } from "../editor/text.js";
import { documentIn } from "../editor/written.js";
import { button, workButton } from "../interface/button.js";
import { element, fill } from "../interface/element.js";
import { Estimate } from "../interface/estimate.js";
import { short, typed } from "../interface/numbers.js";
import { forget, go, note, route } from "../interface/route.js";
import { someDuration } from "../interface/some_duration.js";
import { onNewColours } from "../mechanism/palette.js";
import { patiently, untilAnswered } from "../requests/patiently.js";
import { get, pause, post } from "../requests/service.js";

const QUIET = 500; // ms without typing before the service checks
const ROUNDING = 1e-7; // share of the largest number beside it below which one is told as zero

export async function show(room, { query, signal }) {
  const [schema, { scenes }, asked] = await Promise.all([
    get("/v1/schemas/scene.json", {}, signal), get("/v1/scenes", {}, signal), askedFor(query, signal),
  ]);
  const text = asked ?? kept() ?? pretty(FIRST_SCENE);
  new Editing(room, new SceneSchema(schema), scenes, text, signal);
}

/** Returns the text of the preset or the job that the address names; null: it names none. */
async function askedFor(query, signal) {
  if (query.has("preset")) return pretty(await get(`/v1/scenes/${encodeURIComponent(query.get("preset"))}`, {}, signal));
  if (query.has("job")) return pretty((await get(`/v1/jobs/${encodeURIComponent(query.get("job"))}`, {}, signal)).job.scene);
  return null;
}

/** Writes a document with a line for each field, and lists of numbers in one. */
function pretty(document) {
  return JSON.stringify(document, null, 2).replace(/\[\s+(-?[\d.e+-]+),\s+(-?[\d.e+-]+)\s+\]/g, "[$1, $2]");
}

/** Tells what a check found out about a scene, in a sentence. */
function factsOf({ freedom, ideal_freedom: ideal, joints_with_clearance: loose, assemblies, channels }) {
  const free = loose.length ? `${freedom}, or ${ideal} without the clearance of ${loose.join(", ")}` : ideal;
  const ways = assemblies.length > 1 ? ` It can be put together in ${assemblies.length} ways.` : "";
  const told = channels === null ? "" : ` A run records ${channels} channels.`;
  return `Degrees of freedom: ${free}.${ways}${told}`;
}

/** Tells what a scene asks for that a run of it does not do, or may do otherwise than meant. */
function notesOf({ given, turn, overshoots, replaced, hints }) {
  const missed = given.filter(({ kept }) => !kept).map(({ pointer, unit, given: asked, taken }) => {
    const rounding = ROUNDING * Math.max(...asked.map(Math.abs), ...taken.map(Math.abs));
    const told = (numbers) => numbers.map((number) =>
      short(Math.abs(number) > rounding ? number : 0, 6)).join(", ");
    return `${pointer} asks for ${told(asked)} ${unit}; the start has ${told(taken)} ${unit}.`;
  });
  const defaults = replaced.map(({ pointer, parameter, written, taken }) =>
    `The default of parameter ${parameter} puts ${taken} in place of ${written} at ${pointer}.`);
  const others = [...overshoots, ...hints].map(({ detail }) => detail);
  return [...missed, ...(turn?.jams ? [turn.detail] : []), ...defaults, ...others];
}

/** Returns what the service found wrong, or why it did not answer. */
function faultsOf({ errors, message }) {
  return errors?.length ? errors : [{ pointer: "", detail: message }];
}

class Editing {
  constructor(room, schema, scenes, text, signal) {
    Object.assign(this, { signal, first: text, document: {}, checking: new AbortController() });
    this.motion = new FreeMotion((found) => this.posed(found), (...poses) => this.startIn(...poses), signal);
    this.messages = element("ul", { class: "messages", "aria-live": "polite", "aria-label": "What is wrong" });
    this.facts = element("p", { class: "quiet", role: "status" });
    this.notes = element("ul", { class: "quiet", "aria-label": "What a run does otherwise" });
    const duration = route().query.get("duration") ?? "";
    this.duration = element("input", { id: "duration", inputmode: "decimal", value: duration });
    this.button = workButton("Run", () => this.run(), (error) => error && this.tell(faultsOf(error)), { class: "main" });
    this.more = button("Vary it …", () => go(["new"], this.study()));
    this.estimate = new Estimate(() => this.job(), signal, (errors) => this.tell(errors));
    this.text = new TextEditor(kept() ?? text, help(schema, () => this.document), (now) => this.changed(now));
    this.presets = element("select", { id: "preset", onchange: () => this.begin(this.presets.value) },
      ["", ...scenes.map(({ name }) => name)].map((name) =>
        element("option", { value: name }, name || "choose …")));
    fill(
      room,
      element("div", { class: "head" }, element("h1", {}, "Your own mechanism"),
        element("div", { class: "buttons" },
          sceneFiles(() => ({ text: this.text.text, name: this.document?.name }), (written) => this.take(written)),
          element("label", { for: "preset", class: "small" }, "Begin with"), this.presets)),
      element("p", { class: "quiet" }, "Ctrl+Space proposes what may stand here; hover over a word"
        + " to read what it means. Lengths in m, masses in kg, angles in rad. The text is kept until this tab is closed."),
      element("div", { class: "editing" }, this.text.element,
        element("div", { class: "stacked" },
          element("section", { class: "panel" }, this.motion.element, this.facts, this.notes, this.messages),
          element("section", { class: "panel stacked" },
            element("div", { class: "field" }, element("label", { for: "duration" }, "Duration"),
              element("div", { class: "entry" }, this.duration, element("span", { class: "unit" }, "s"))),
            this.estimate.element,
            element("div", { class: "buttons" }, this.button, this.more)))),
      fieldList(schema.schema),
    );
    this.duration.addEventListener("input", () => this.estimate.later());
    onNewColours(() => this.motion.draw(), signal);
    addEventListener("resize", () => this.motion.draw(), { signal });
    if (this.text.text === text) this.changed(text);
    else this.text.text = text; // what was written before is one undo away
  }

  /** Writes a pose into the text as the start of its scene; the earlier text is one undo away. */
  startIn(scene, pose, before) {
    try {
      this.text.text = pretty(startedIn(documentIn(this.text.text), scene, pose, before));
    } catch (error) {
      this.tell(error.faults ?? [{ pointer: "", detail: error.message }]);
    }
  }

  async begin(name) {
    if (name) this.take(pretty(await get(`/v1/scenes/${encodeURIComponent(name)}`, {}, this.signal)));
    this.presets.value = ""; // it may be chosen again
  }

  /** Replaces the text by another; the earlier one is one undo away. */
  take(text) {
    this.duration.value = "";
    this.text.text = text;
    forget();
  }

  changed(text) {
    keep(text);
    if (text !== this.first) note({ preset: null, job: null }); // who comes back finds what was written
    try {
      this.document = documentIn(text);
    } catch (error) {
      this.checking.abort();
      this.motion.missed();
      fill(this.facts);
      fill(this.notes);
      this.estimate.refresh(); // which says that there is none
      this.tell(error.faults);
      return;
    }
    this.tell([]);
    this.checked = false;
    this.motion.show(this.document);
    this.check();
  }

  /** Says at once if a scene does not close, and proposes a duration where none is given. */
  posed(found) {
    if (found.stopped && !this.checked) this.tell([{ pointer: "/start", detail: found.stopped.detail }]);
    if (this.duration.value && this.duration.value !== this.proposed) return; // it was typed
    this.proposed = String(someDuration(this.document, found));
    if (this.duration.value === this.proposed) return;
    this.duration.value = this.proposed;
    if (this.checked) this.estimate.later(); // else it is asked for when the check has ended
  }

  /** Asks the service whether the scene can be run, and then what a run costs. */
  async check() {
    this.checking.abort();
    this.checking = new AbortController();
    const { signal } = this.checking;
    try {
      await pause(QUIET, signal);
      const ask = () => patiently(() => post("/v1/scenes/check", this.document, signal), signal);
      const found = await untilAnswered(ask, signal, { away: true });
      this.checked = true;
      fill(this.facts, factsOf(found));
      fill(this.notes, notesOf(found).map((sentence) => element("li", {}, sentence)));
      this.tell(found.problems);
      if (found.problems.length) this.estimate.none(found.problems[0].detail);
      else this.estimate.refresh();
    } catch (error) {
      if (error.name === "AbortError") return; // typed on
      fill(this.facts);
      fill(this.notes);
      this.tell(faultsOf(error));
      this.estimate.refresh();
    }
  }

  /**
   * Returns what the address says of a study of the mechanism, and the job if the text is still its scene; and the
   * duration that was typed.
   */
  study() {
    const { preset, ...query } = Object.fromEntries(route().query);
    const { value } = this.duration;
    return value && value !== this.proposed ? { ...query, duration: value } : query;
  }

  job() {
    const duration = typed(this.duration.value);
    if (!(duration > 0)) throw new Error("Give a duration in s.");
    return { kind: "simulate", scene: documentIn(this.text.text), duration };
  }

  /** Shows what is wrong, at its place and in a list; pointers may lead into a job. */
  tell(errors) {
    const shown = errors.map((one) =>
      one.pointer === undefined ? one : { ...one, pointer: one.pointer.replace(/^\/scene(?=\/|$)/, "") });
    this.text.mark(shown);
    fill(this.messages, shown.map(({ pointer, detail }) => element("li", {}, detail, " ",
      pointer && button(element("code", {}, pointer), () => this.text.reveal(pointer)))));
    this.button.disabled = this.more.disabled = shown.some(({ from }) => from !== undefined);
  }

  async run() {
    const job = await post("/v1/jobs", this.job());
    go(["job", job.id]);
  }
}

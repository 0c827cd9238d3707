/** A new job of a preset, or of the scene that is being written: its parameters, its cost before it is submitted, and how others submit it. */

import { kept } from "../editor/kept.js";
import { documentIn } from "../editor/written.js";
import { asBefore, without } from "../interface/as_before.js";
import { element, fill } from "../interface/element.js";
import { inAddress, ofParameters } from "../interface/form_address.js";
import { Estimate } from "../interface/estimate.js";
import { jobAsText } from "../interface/job_as_text.js";
import { KINDS, fieldsOf, kindsOfJobs, namesOfFields, offers } from "../interface/kinds_of_job.js";
import { ParameterFields } from "../interface/parameter_fields.js";
import { withUnit } from "../interface/numbers.js";
import { go, note, route } from "../interface/route.js";
import { fields as wrongFields } from "../interface/trouble.js";
import { onNewColours } from "../mechanism/palette.js";
import { withDefaults, withParameters } from "../mechanism/parameters.js";
import { Sketch, calm } from "../mechanism/sketch.js";
import { jobIfThere } from "../requests/jobs.js";
import { get, pause, post } from "../requests/service.js";

const QUIET = 400; // ms without a change before what suits the parameters is asked

export async function show(room, { parts, query, signal }) {
  const [wanted] = parts;
  const before = query.has("job") ? (await jobIfThere(query.get("job"), signal))?.job ?? null : null;
  const document_ = wanted ? await get(`/v1/scenes/${encodeURIComponent(wanted)}`, {}, signal)
    : before?.scene ?? written();
  const { name } = document_;
  document.title = `${name} · jointplay`;
  await kindsOfJobs(signal);
  const kind = Object.hasOwn(KINDS, query.get("kind") ?? "") ? query.get("kind") : "simulate";
  const given = inAddress(query, document_.parameters ?? {}, namesOfFields(kind, document_));
  const canvas = element("canvas", { role: "img", "aria-label": `Drawing of ${name}` });
  const offered = await offers(withDefaults(document_, given.parameters), signal);
  const beginning = { kind, label: query.get("label") ?? "", given };
  const form = new JobForm(document_, { wanted, before }, beginning, offered, signal);
  const turn = element("p", { class: "quiet small", role: "status" });
  const sketch = new Sketch(canvas, { labels: true, onFound: ({ drivers_time: once, repeats }) =>
    fill(turn, once !== null && repeats && `Its drivers come round every ${withUnit(once, "s")}.`) }, signal);
  const redraw = () => {
    const { valid } = form.parameters;
    if (!valid && sketch.scene) return; // what was right last stays
    sketch.show(withParameters(document_, valid ? form.parameters.values() : {}));
  };
  form.onchange = () => {
    note(form.address());
    redraw();
  };
  fill(
    room,
    element("div", { class: "head" }, element("h1", {}, name.replaceAll("-", " "))),
    element("p", { class: "quiet" }, document_.description),
    element(
      "div",
      { class: "split" },
      form.element,
      element(
        "div",
        { class: "stacked" },
        element("div", { class: "panel" }, element("div", { class: "stage" }, canvas), turn),
        element("section", { class: "panel" }, element("h2", {}, "The same job elsewhere"),
          form.text.element),
        document_.source && element("section", { class: "panel small quiet" },
          element("h2", {}, "Source"), document_.source),
      ),
    ),
  );
  redraw();
  if (!calm()) sketch.play();
  onNewColours(() => sketch.draw(), signal);
  addEventListener("resize", () => sketch.draw(), { signal });
  signal.addEventListener("abort", () => sketch.stop());
  form.estimate.refresh();
}

/** Returns the scene that is being written in this tab. */
function written() {
  const text = kept();
  if (text === null) throw new Error("No mechanism is being written in this tab; begin under “Your own”.");
  return documentIn(text);
}

class JobForm {
  constructor(document_, { wanted, before }, { kind, label, given }, offered, signal) {
    Object.assign(this, { scene: document_, isPreset: Boolean(wanted), before, offered, signal, onchange: () => {} });
    this.asking = new AbortController();
    signal.addEventListener("abort", () => this.asking.abort());
    const changed = () => this.changed();
    this.parameters = new ParameterFields(document_.parameters ?? {}, given.parameters, () => {
      changed();
      this.follow().catch(() => {});
    });
    this.kindRoom = element("div");
    this.label = element("input", { id: "label", maxlength: 200, value: label, oninput: changed });
    this.kind = element("select", { id: "kind", onchange: () => this.choose(this.kind.value) },
      Object.entries(KINDS).map(([name, { title }]) =>
        element("option", { value: name, selected: name === kind }, title)));
    this.kindHelp = element("p", { class: "help", id: "kind-help" });
    this.beginning = element("p", { class: "help" });
    this.wrong = element("div", { role: "alert" });
    this.button = element("button", { type: "submit", class: "main" }, "Run");
    this.estimate = new Estimate(() => this.document(), signal, (errors) => this.blame(errors));
    this.element = element(
      "form",
      { class: "panel stacked", novalidate: true, onsubmit: (event) => this.submit(event) },
      element("div", { class: "field" }, element("label", { for: "kind" }, "What to compute"),
        this.kind, this.kindHelp, this.beginning),
      this.kindRoom,
      element("h2", {}, "Parameters of the mechanism"),
      Object.keys(document_.parameters ?? {}).length ? this.parameters.element : element("p", { class: "help" },
        "It declares none. A study varies what “parameters” of the scene name: add them under “Your own”."),
      element("div", { class: "field" }, element("label", { for: "label" }, "Label"), this.label,
        element("p", { class: "help" }, "A name of your own, to find the job by.")),
      element("div", { class: "acting" }, this.estimate.element, this.wrong,
        element("div", { class: "buttons" }, this.button)),
    );
    this.text = { refresh() {} };
    this.choose(kind, given.fields);
    this.text = jobAsText(() => this.document());
  }

  choose(kind, given = {}) {
    this.kind.value = kind;
    this.kindHelp.textContent = KINDS[kind].help;
    this.own = this.fields(given);
    this.earlier = this.before?.kind === kind ? this.asEarlier() : null;
    fill(this.beginning, this.earlier && "What has no field here is as in the job that is changed.");
    fill(this.kindRoom, this.own.element);
    this.changed();
  }

  /** Returns the fields of the kind, with what suits the parameters as they are typed. */
  fields(given) {
    const scene = withDefaults(this.scene, this.parameters.valid ? this.parameters.values() : {});
    return fieldsOf(this.kind.value, scene, this.offered, given, () => this.changed());
  }

  /** Proposes anew what nobody has typed, once the parameters have stood for a while. */
  async follow() {
    this.asking.abort();
    this.asking = new AbortController();
    const { signal } = this.asking;
    await pause(QUIET, signal);
    if (!this.parameters.valid) return;
    const offered = await offers(withDefaults(this.scene, this.parameters.values()), signal);
    if (signal.aborted) return;
    this.offered = offered;
    if (!this.own.given) return; // a table of what was measured: nothing in it is proposed
    const before = JSON.stringify(this.own.all());
    const { id, selectionStart: from, selectionEnd: to } = document.activeElement;
    const within = this.kindRoom.contains(document.activeElement);
    this.own = this.fields(this.own.given());
    fill(this.kindRoom, this.own.element);
    if (within) {
      const again = document.getElementById(id);
      again?.focus();
      if (typeof from === "number") again?.setSelectionRange(from, to);
    }
    if (JSON.stringify(this.own.all()) !== before) this.changed();
  }

  changed() {
    this.text.refresh();
    this.estimate?.later();
    this.onchange();
  }

  /** Returns what the address notes of the form; null of what it noted before, and of another kind. */
  address() {
    const kind = this.kind.value === "simulate" ? null : this.kind.value;
    const noted = [...route().query.keys()].filter((name) => name !== "job");
    return {
      ...Object.fromEntries(noted.map((name) => [name, null])), kind, label: this.label.value.trim(),
      ...ofParameters(this.parameters.values()), ...this.own.values(),
    };
  }

  /** Returns the job's document; throws where a field is wrong. */
  document() {
    const fine = [this.own.valid, this.parameters.valid].every(Boolean);
    if (!fine) throw new Error(this.own.lacking ?? "Correct the marked fields first.");
    const parameters = this.parameters.values();
    const kind = this.kind.value;
    const named = { preset: this.scene.name, ...(Object.keys(parameters).length ? { parameters } : {}) };
    const scene = this.isPreset ? named : withDefaults(this.scene, parameters);
    const label = this.label.value.trim();
    const made = KINDS[kind].made(this.own.all());
    const all = this.earlier ? asBefore(this.earlier.document, this.earlier.made, made) : made;
    return { kind, scene, ...all, ...(label ? { label } : {}) };
  }

  /** Returns what the form would make of the earlier job, and what of that job's document stays as it is. */
  asEarlier() {
    const { kind, scene, label, ...document } = this.before;
    const fields = fieldsOf(kind, this.scene, this.offered, KINDS[kind].given(this.before), () => {});
    if (kind === "calibration" && !fields.valid) return null; // its table is not of this mechanism
    const own = fields.all();
    const made = KINDS[kind].made(own);
    return { made, document: without(document, Object.keys(own).filter((name) => !(name in made))) };
  }

  /** Shows beside its field what the service found wrong; returns what belongs to none. */
  blame(errors) {
    return this.own.blame(this.parameters.blame(errors));
  }

  async submit(event) {
    event.preventDefault();
    if (this.button.hasAttribute("aria-disabled")) return; // it keeps the keyboard, which a disabled one loses
    fill(this.wrong);
    this.button.setAttribute("aria-disabled", "true");
    try {
      const job = await post("/v1/jobs", this.document());
      go(["job", job.id]);
    } catch (error) {
      const left = this.blame(error.errors ?? []);
      fill(this.wrong, element("p", { class: "notice bad" }, error.message),
        wrongFields({ errors: left, message: error.message }));
      this.element.querySelector("[aria-invalid=true]")?.focus();
    } finally {
      this.button.removeAttribute("aria-disabled");
    }
  }
}

/** One point of a study: the values of its parameters, and the simulation that has them. */

import { workButton } from "./button.js";
import { element, fill } from "./element.js";
import { withUnit } from "./numbers.js";
import { go } from "./route.js";
import { preset, sceneOf } from "./scene_of_job.js";
import { proposedDuration } from "./some_duration.js";
import { withDefaults } from "../mechanism/parameters.js";
import { post } from "../requests/service.js";

/**
 * Tells of a point, and offers to run its simulation.
 *
 * @param study job of the study, as the service shows it
 * @param values `{parameter: [value, unit]}`
 * @param words what is known of the point
 * @param beside what stands beside the button, in short
 * @param others further jobs that are offered: `{title: document of the scene with these values}`
 * @param starts numbers of the start at the point: `{pointer into the scene: value}`, or a `state` that the
 *   simulation begins in, as a list
 */
export function offer(room, study, values, words, beside, others = {}, starts = {}) {
  const named = (digits) => Object.entries(values).map(([name, [value, unit]]) =>
    `${name} = ${withUnit(value, unit, digits)}`).join(", ");
  const plain = Object.fromEntries(Object.entries(values).map(([name, [value]]) => [name, value]));
  const refused = element("div");
  const tell = (error) => fill(refused, error && element("p", { class: "notice bad" }, error.message));
  const submitting = (title, made, look = "") => workButton(title, async () => {
    const job = await post("/v1/jobs", { ...(await made()), label: named(4) });
    go(["job", job.id]);
  }, tell, { class: look });
  fill(room, element("div", { class: "notice" },
    element("p", {}, element("strong", {}, named(6)), `: ${words}`),
    element("div", { class: "buttons" },
      submitting("Run this simulation", () => simulation(study.job, plain, starts), "main"),
      Object.entries(others).map(([title, document]) => submitting(title, () => document(plain))),
      element("span", { class: "quiet small" }, beside)),
    refused));
}

/** Returns the document of the run of a study's scene with these values. */
async function simulation({ scene: given, tolerance, method, duration }, values, starts) {
  const long = typeof duration === "number" ? duration : await proposedDuration(await declaring(given, values));
  const shared = { kind: "simulate", duration: long, tolerance, method };
  if (Array.isArray(starts)) return { ...shared, scene: sceneWith(given, values), state: starts };
  const scene = Object.keys(starts).length
    ? await sceneStarting(given, values, starts)
    : sceneWith(given, values);
  return { ...shared, scene };
}

/** Returns the document of a job's scene with these values as the defaults of its parameters. */
async function declaring(given, values) {
  const scene = sceneWith(given, ofParameters(values));
  return given.preset ? withDefaults(await preset(given.preset), scene.parameters) : scene;
}

/** Returns the values of parameters, without those of numbers of the start: `joint.position` and the like. */
function ofParameters(values) {
  return Object.fromEntries(Object.entries(values).filter(([name]) => !name.includes(".")));
}

/** Returns a scene of its own with these values of parameters, which starts with these numbers. */
async function sceneStarting(given, values, starts) {
  const { parameters, ...document } = structuredClone(await sceneOf({ scene: sceneWith(given, ofParameters(values)) }));
  for (const [pointer, value] of Object.entries(starts)) {
    const keys = pointer.slice(1).split("/");
    const last = keys.pop();
    let at = document;
    keys.forEach((key, nth) => {
      at[key] ??= nth === keys.length - 1 && /^[01]$/.test(last) ? [0, 0] : {};
      at = at[key];
    });
    at[last] = value;
  }
  return document;
}

/** Returns the scene of a job's document with these values of its parameters. */
export function sceneWith(given, values) {
  const declared = given.parameters ?? {};
  const set = given.preset
    ? { ...Object.fromEntries(Object.entries(declared).filter(([, value]) => value !== null)), ...values }
    : { ...declared, ...Object.fromEntries(Object.entries(values).map(([name, value]) =>
        [name, { ...declared[name], default: value }])) };
  return { ...given, parameters: set };
}

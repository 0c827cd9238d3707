/** The state of a job as a mark, and how far it is in words. */

import { element } from "./element.js";
import { short, withUnit } from "./numbers.js";

/** Returns the mark of a job's state. */
export function stateMark(state) {
  return element("span", { class: `state state-${state}` }, state);
}

/** Returns how far a job is, in a sentence. */
export function progressWords({ state, activity, progress, job }) {
  const percent = `${short(100 * (progress?.fraction ?? 0), 3)} %`;
  if (state === "queued") return "waiting for a worker";
  if (state === "succeeded") return "finished";
  if (state === "failed" || state === "cancelled") return `ended at ${percent}`;
  const reached = job?.kind === "simulate" && progress?.time
    ? `, ${withUnit(progress.time, "s")} of ${withUnit(job.duration, "s")} simulated`
    : "";
  if (activity && !progress?.fraction) return activity;
  return `${percent}${reached}${activity ? `, ${activity}` : ""}`;
}

/** Returns the name of the mechanism of a job's document. */
export function sceneName(document) {
  return document?.scene?.preset ?? document?.scene?.name ?? "mechanism";
}

/** Returns the parameters that a document sets otherwise than the defaults, in short. */
export function parameterWords(document, declared = {}) {
  const given = document?.scene?.parameters ?? {};
  const own = Object.entries(given).filter(([name, value]) => {
    if (value === null || typeof value === "object") return false;
    return !(name in declared) || declared[name].default !== value;
  });
  return own.map(([name, value]) =>
    `${name} ${typeof value === "number" ? withUnit(value, declared[name]?.unit ?? "1") : value}`,
  ).join(", ");
}

/** What a job computes, in a few words: what it sets otherwise than the scene, and what it varies. */

import { withUnit } from "./numbers.js";
import { preset } from "./scene_of_job.js";
import { startNumber } from "./start_numbers.js";
import { parameterWords } from "./state.js";

/** Returns the parameters that the scene of a job's document declares. */
export async function declaredFor({ scene }) {
  const declaring = scene?.preset ? await preset(scene.preset).catch(() => ({})) : scene;
  return declaring?.parameters ?? {};
}

/** Returns the words of a job's document. */
export function jobWords(document, declared) {
  const { kind, duration, grid, parameters } = document;
  const over = (varied, all) => {
    const [from, to] = Array.isArray(all) ? [all[0], all.at(-1)] : [all.from, all.to];
    const { name, unit } = named(varied, declared);
    return `${name} ${[from, to].map((one) => withUnit(one, unit)).join(" … ")}`;
  };
  const axes = [document, ...Object.values(document)].filter((one) => (one?.parameter ?? one?.start) && one.values);
  const verb = { calibration: "finds", sensitivity: "draws" }[kind];
  const varied = verb ? [`${verb} ${Object.keys(parameters).join(", ")}`] : [
    starts(document.starts),
    ...axes.map((one) => over(one.parameter ?? one.start, one.values)),
    ...Object.entries(grid ?? {}).map(([name, all]) => over(name, all)),
  ];
  return [...varied, duration && withUnit(duration, "s"), parameterWords(document, declared)]
    .filter(Boolean).join(", ");
}

/** Returns the words of starts that are drawn, or of how many each point has; none of the scene's own. */
function starts(found) {
  if (typeof found === "number") return found > 1 && `${found} starts a point`;
  return found && `draws ${Object.keys(found).map((one) => named(one, {}).name).join(", ")}`;
}

/** Returns the name and unit of a parameter, or of a number of the start by its pointer. */
function named(varied, declared) {
  return varied.startsWith("/") ? startNumber(varied) : { name: varied, unit: declared[varied]?.unit ?? "1" };
}

const OF_ANY = { tolerance: "1", method: "1", duration: "s" }; // what jobs of all mechanisms have, and its unit

/**
 * Returns, for each of some jobs, the parameters in which they differ if their scene is the same preset,
 * or has the same name; and in how they are computed.
 */
export function differing(jobs, declared) {
  const same = new Set(jobs.map(({ job }) => `${job.scene?.preset ?? ""}/${job.scene?.name ?? ""}`)).size < 2;
  const units = Object.fromEntries(Object.entries(declared).map(([name, { unit }]) => [name, unit]));
  const all = jobs.map(({ job }) => ({
    ...(same ? valuesOf(job.scene ?? {}) : {}),
    ...Object.fromEntries(Object.keys(OF_ANY).map((name) => [name, job[name]])),
  }));
  const names = [...new Set(all.flatMap(Object.keys))]
    .filter((name) => new Set(all.map((one) => one[name])).size > 1);
  const told = (name, value) => (typeof value === "number"
    ? withUnit(value, units[name] ?? OF_ANY[name] ?? "1") : value);
  return all.map((one) => names.filter((name) => one[name] !== undefined && one[name] !== null)
    .map((name) => `${name} ${told(name, one[name])}`).join(", "));
}

/** Returns the values of a scene's parameters: those of a mechanism of one's own are its defaults. */
function valuesOf({ preset: shipped, parameters }) {
  if (shipped) return parameters ?? {};
  return Object.fromEntries(Object.entries(parameters ?? {}).map(([name, one]) => [name, typeof one === "object" ? one?.default : one]));
}

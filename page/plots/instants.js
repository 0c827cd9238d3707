/** Many values of channels in a window of time: a million of each, in answers that are allowed. */

import { getArrays } from "../requests/arrays.js";
import { get } from "../requests/service.js";

const MOST_VALUES = 990_000; // in one answer of the service, which carries a million

/**
 * Returns `{columns, units, step, exact}` of a run.
 *
 * Values are equally far apart, between samples too, where the run keeps its steps; where it does
 * not, they are the samples at the end of the window.
 *
 * @param job a job of kind `simulate`, as the service shows it
 * @param count how many instants, at least two
 */
export async function instants(job, names, [start, stop], count, signal) {
  const step = (stop - start) / (count - 1);
  const asked = (window, more) => pieces(job, names, window, count, more, signal);
  const beginning = { channels: names[0], start, stop: start + step, points: 1 };
  const { exact } = await get(job.links.history, beginning, signal);
  if (exact) return { ...(await asked([start, stop], { step })), step, exact };
  const { output_step: apart } = job.job;
  const window = [Math.max(start, stop - count * apart), stop];
  return { ...(await asked(window, {})), step: apart, exact: false };
}

async function pieces(job, names, [start, stop], count, more, signal) {
  const wanted = [...new Set(names)];
  const rows = Math.floor(MOST_VALUES / (wanted.length + 1));
  const parts = Math.ceil(count / rows);
  const edges = Array.from({ length: parts + 1 }, (_, i) => start + ((stop - start) * i) / parts);
  const answers = await Promise.all(edges.slice(1).map((last, i) => getArrays(job.links.history, {
    channels: wanted.join(","), start: edges[i], stop: last, ...more,
  }, signal)));
  const columns = Object.fromEntries(wanted.map((name) =>
    [name, joined(answers.map((one) => one.columns[name]))]));
  return { columns, units: answers[0].units };
}

function joined(parts) {
  const whole = new Float64Array(parts.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return whole;
}

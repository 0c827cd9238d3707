/** Many values of channels in a window of time: a million of each, in answers that are allowed. */

import { getArrays } from "../requests/arrays.js";
import { betweenSamples } from "../requests/between_samples.js";

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
  const wanted = [...new Set(names)];
  const exact = await betweenSamples(job, names[0], [start, stop], signal);
  if (exact) {
    const step = (stop - start) / (count - 1);
    return { ...(await pieces(job, wanted, windows([start, stop], step, wanted), { step }, signal)), step, exact };
  }
  const { output_step: step } = job.job;
  const first = Math.ceil(Math.max(start, stop - (count - 1) * step) / step - 1e-9); // sample
  const parts = windows([(first - 0.25) * step, stop], step, wanted); // no sample lies at an edge
  return { ...(await pieces(job, wanted, parts, {}, signal)), step, exact };
}

/** Returns windows `[begin, end]`, each of as many instants as an answer has room for, and none of them in two. */
function windows([start, stop], step, names) {
  const rows = Math.floor(MOST_VALUES / (names.length + 1));
  const count = Math.floor(((stop - start) / step) * (1 + 1e-12)) + 1;
  return Array.from({ length: Math.ceil(count / rows) }, (_, i) => {
    const begin = start + i * rows * step;
    return [Math.max(begin, 0), Math.min(begin + (rows - 0.5) * step, stop)];
  });
}

async function pieces(job, wanted, parts, more, signal) {
  const answers = await Promise.all(parts.map(([start, stop]) => getArrays(job.links.history, {
    channels: wanted.join(","), start, stop, ...more,
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

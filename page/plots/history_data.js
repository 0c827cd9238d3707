/** Histories of jobs in a window of time, no finer than the screen: no peak is lost. */

import { get } from "../requests/service.js";

/**
 * Returns `{channels, note}`: by channel its curves by job, `{curves: [[times, values], …], unit, longName}`,
 * and what is to be known of them, as that their peaks are those of samples alone.
 *
 * @param jobs jobs as the service shows them; what one has not stored is left out
 * @param channels names
 * @param window `[start, stop]` in s; the window is fetched with as much again on both sides
 * @param points pixels of the window
 */
export async function histories(jobs, channels, [start, stop], points, signal) {
  const width = stop - start;
  const asked = { start: Math.max(0, start - width), stop: stop + width, points: 3 * points };
  const answers = await Promise.all(jobs.map((job) => {
    const stored = channels.filter((name) => job.job.channels.includes(name));
    const query = { channels: stored.join(","), ...asked };
    return stored.length ? get(job.links.history, query, signal) : null;
  }));
  const found = {};
  for (const channel of channels) {
    const curves = answers.map((answer) => (answer ? curve(answer, channel) : [[], []]));
    const described = answers.map((answer) =>
      (answer?.extremes ?? answer?.channels)?.[channel]).find(Boolean);
    found[channel] = {
      curves, unit: described?.unit ?? "", longName: described?.long_name ?? "",
    };
  }
  return { channels: found, note: [...new Set(answers.map((answer) => answer?.note).filter(Boolean))].join(" ") };
}

/** Returns times and values; of an overview minimum and maximum of each group in turn. */
function curve({ time, bins, channels, extremes }, channel) {
  if (channels) return channels[channel] ? [time.values, channels[channel].values] : [[], []];
  if (!extremes[channel]) return [[], []];
  const { minimum, maximum } = extremes[channel];
  const times = [];
  const values = [];
  for (let i = 0; i < minimum.length; i++) {
    const last = bins.last[i] > bins.first[i] ? bins.last[i] : bins.first[i] * (1 + 1e-15);
    times.push(bins.first[i], last);
    values.push(minimum[i], maximum[i]);
  }
  return [times, values];
}

/** Numbers as CSV: the curves of a run in a window of time, and tables; with all digits. */

import { workButton } from "./button.js";
import { element } from "./element.js";
import { save } from "./saving.js";
import { betweenSamples } from "../requests/between_samples.js";
import { getBytes, withQuery } from "../requests/service.js";

const STEPS = 2000; // of a window, where a run keeps what is between its samples

/** Returns a button that saves a table; `rows` are lists of texts and numbers, as long as `titles`. */
export function tableAsCsv(name, titles, rows) {
  return saving(() => {
    const lines = [titles, ...rows].map((row) => row.map(cell).join(","));
    return save(new Blob([`${lines.join("\n")}\n`], { type: "text/csv" }), `${name}.csv`);
  }, `Save ${name} as CSV`);
}

/**
 * Returns a button that saves channels of a run, in equal steps, or its samples where it kept no more.
 *
 * @param shown returns `{channels, window: [start, stop]}` in s
 */
export function historyAsCsv(job, shown, signal) {
  return saving(async () => {
    const { channels, window: [start, stop] } = shown();
    const step = (stop - start) / STEPS;
    const query = { channels: channels.join(","), start, stop };
    const finer = await betweenSamples(job, channels[0], [start, stop], signal);
    const path = withQuery(job.links.history, finer ? { ...query, step } : query);
    save(new Blob([await getBytes(path, "text/csv", signal)], { type: "text/csv" }), "history.csv");
  }, "Save these curves as CSV");
}

function saving(act, text) {
  const said = element("span", { role: "status", class: "small quiet" });
  const tell = (error) => (said.textContent = error?.message ?? "");
  return element("div", { class: "buttons saving" }, workButton(text, act, tell), said);
}

function cell(value) {
  const text = String(value ?? "");
  return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

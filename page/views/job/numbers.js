/** Numbers of a run: extremes of every channel, contacts, the energy ledger. */

import { tableAsCsv } from "../../interface/csv.js";
import { element, fill } from "../../interface/element.js";
import { notRounding, short, withUnit } from "../../interface/numbers.js";
import { table } from "../../interface/table.js";
import { whenThere } from "../../interface/when_there.js";
import { contacts } from "../../requests/contacts.js";
import { get } from "../../requests/service.js";

const MOST_IMPACTS = 200;
const COLUMNS = { // of contacts, as the command line names them
  joint: "joint", onset: "onset [s]", release: "release [s]", approach_rate: "approach_rate [m/s]",
  peak_force: "peak_force [N]", impulse: "impulse [N s]",
};

export async function show(room, context) {
  const { job, signal } = context;
  await whenThere(room, context, job.links.peaks, {}, async ({ peaks }) => {
    const none = () => null;
    const [statistics, found] = await Promise.all([
      get(job.links.statistics, {}, signal).catch(none),
      contacts(job.links.impacts, job.job.duration, signal).catch(none),
    ]);
    fill(
      room,
      element("div", { class: "split" },
        element("section", { class: "panel" }, element("h2", {}, "Extremes"),
          job.job.settle > 0 && element("p", { class: "quiet small" }, `From ${withUnit(job.job.settle, "s")} on.`),
          peakTable(peaks)),
        element("div", { class: "stacked" },
          statistics && element("section", { class: "panel" }, element("h2", {}, "The computation"),
            ledger(statistics)),
          found && element("section", { class: "panel" },
            element("h2", {}, headOf(found)), impactTable(found.impacts)))),
    );
  });
}

function headOf({ impacts: { length }, until }) {
  return until === null ? `${length} contacts` : `The first ${length} contacts, until ${withUnit(until, "s", 6)}`;
}

function peakTable(peaks) {
  const rows = Object.entries(peaks).map(([name, peak]) => [
    name,
    withUnit(notRounding(peak.minimum, peak.maximum), peak.unit), withUnit(peak.minimum_time, "s"),
    withUnit(notRounding(peak.maximum, peak.minimum), peak.unit), withUnit(peak.maximum_time, "s"),
  ]);
  const all = Object.entries(peaks).map(([name, peak]) =>
    [name, peak.unit, peak.minimum, peak.minimum_time, peak.maximum, peak.maximum_time]);
  return [
    table("Extremes", ["Channel", "Smallest", "at", "Largest", "at"], rows),
    tableAsCsv("extremes",
      ["channel", "unit", "minimum", "minimum_time [s]", "maximum", "maximum_time [s]"], all),
  ];
}

function impactTable(impacts) {
  const shown = impacts.slice(0, MOST_IMPACTS).map((one) => [
    one.joint, withUnit(one.onset, "s", 6),
    one.release === null ? "lasts" : withUnit(one.release - one.onset, "s", 3),
    withUnit(one.approach_rate, "m/s", 3), withUnit(one.peak_force, "N", 3),
  ]);
  return [
    table("Contacts", ["Joint", "Onset", "Duration", "Approach", "Peak force"], shown),
    impacts.length > MOST_IMPACTS &&
      element("p", { class: "quiet small" }, `The first ${MOST_IMPACTS} are shown.`),
    tableAsCsv("contacts", Object.values(COLUMNS), impacts.map((one) =>
      Object.keys(COLUMNS).map((name) => one[name]))),
  ];
}

function ledger({ method, method_reason: reason, steps, rejections, smallest_step: step, energy }) {
  const rows = [
    ["Method", method ?? "–"], ["because", reason ?? "–"], ["Steps", short(steps, 6)],
    ["Tried again", short(rejections, 6)], ["Smallest step", withUnit(step, "s", 3)],
  ];
  for (const [name, value] of Object.entries(energy ?? {})) {
    rows.push([name.replaceAll("_", " "), withUnit(value, "J")]);
  }
  return table("The computation", ["Quantity", "Value"], rows);
}

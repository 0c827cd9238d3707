/** How far results can be trusted, in words; and what accuracy costs, of an accuracy-study. */

import { convergence, gaps } from "../../interface/converged.js";
import { element, fill } from "../../interface/element.js";
import { freshFigure } from "../../interface/fresh_figure.js";
import { notRounding, short, span, withUnit } from "../../interface/numbers.js";
import { table } from "../../interface/table.js";
import { whenThere } from "../../interface/when_there.js";

export async function show(room, context) {
  const { links, job } = context.job;
  if (links.accuracy) {
    await whenThere(room, context, links.accuracy, {}, async (answer) => {
      const drawn = context.job.state === "succeeded"
        && element("section", { class: "panel" }, element("h2", {}, "Work-precision diagram"));
      fill(room, study(answer, drawn));
      if (!drawn) return;
      drawn.append(await freshFigure(`${links.figures}/work-precision.svg`, "Error of each method against its cost"));
    });
  } else if (job.certificate === false) {
    fill(room, element("p", { class: "panel" }, "This run was computed without a certificate."));
  } else {
    await whenThere(room, context, links.certificate, {}, (answer) =>
      fill(room, certificate(answer, job)), ["succeeded", "failed"]);
  }
}

function certificate(found, { duration, settle }) {
  const statements = words(found, duration, settle);
  return element("div", { class: "split beside" },
    element("section", { class: "panel" },
      element("h2", {}, "What you can trust"),
      statements.map((sentence) => element("p", {}, sentence)),
      found.note && element("p", { class: "quiet small" }, found.note),
      found.criterion && element("details", {}, element("summary", {}, "What converged means"),
        element("p", {}, found.criterion),
        Object.entries(found.bars).map(([kind, sentence]) =>
          element("p", { class: "small" }, element("strong", {}, kind), ": ", sentence)))),
    element("section", { class: "panel" }, element("h2", {}, "Channel by channel"),
      gaps(found, 0, duration).length > 0 && element("p", { class: "quiet small" },
        "A channel may stay accurate where the motion is not converged: its own error is small there,"
        + " while a journal or a body elsewhere takes another path."),
      channels(found)));
}

/** Returns sentences about a certificate, the most important first. */
function words(found, duration, settle) {
  const { forces_until: forces } = found;
  const [course, growth] = convergence(found, duration);
  const sentences = [course];
  const far = !gaps(found, 0, duration).length;
  const spread = spreads(found.channels);
  if (!far && spread) {
    const whole = settle > 0 ? " of the whole run, settling included," : "";
    sentences.push(`Largest values${whole} agree between runs with other tolerances: ${spread}.`);
  }
  if (forces !== null && forces !== undefined && !far) {
    sentences.push(`Forces and accelerations are accurate until ${withUnit(forces, "s", 3)}.`);
  }
  if (found.impacts && found.impacts.until < duration * (1 - 1e-9)) {
    const { until, certified, count } = found.impacts;
    sentences.push(`Trust the list of impacts until ${withUnit(until, "s", 3)}, ${certified} of ${count}.`
      + " How many follow, and when, is what the steps of this run made of it.");
  }
  if (growth) sentences.push(growth);
  if (found.energy_error !== null && found.energy_error !== undefined) {
    sentences.push(`Energy is accounted for to ${short(100 * Math.abs(found.energy_error), 2)} % of`
      + " all work that was done.");
  }
  return sentences;
}

/** Returns how far the largest values of declared outputs and of forces are apart, in words. */
function spreads(channels) {
  const groups = [
    ["declared outputs", (name) => !name.includes(".")],
    ["contact forces", (name) => name.endsWith(".normal_force")],
  ];
  return groups.map(([title, belongs]) => {
    const shares = Object.entries(channels)
      .filter(([name, { extremes: e }]) => belongs(name) && e.highest_maximum && e.lowest_maximum !== null)
      .map(([, { extremes: e }]) => Math.abs(1 - e.lowest_maximum / e.highest_maximum));
    return shares.length && `those of ${title} within ${short(100 * Math.max(...shares), 2)} %`;
  }).filter(Boolean).join(", ");
}

function channels({ channels: found }) {
  const between = (low, high, unit, beside) => {
    if (low === null || high === null) return "–";
    const [a, b] = [low, high].map((value) =>
      withUnit(notRounding(value, beside), unit, 3).replaceAll(" ", "\u00a0"));
    return a === b ? a : `${a} … ${b}`;
  };
  return table("Channels", ["Channel", "Accurate until", "Smallest", "Largest"],
    Object.entries(found).map(([name, { until, unit, extremes: e }]) => [
      name, until === null ? "–" : withUnit(until, "s", 3),
      between(e.lowest_minimum, e.highest_minimum, unit, e.highest_maximum),
      between(e.lowest_maximum, e.highest_maximum, unit, e.lowest_minimum),
    ]), "small ranges");
}

/** Returns what a study found by now, beside its diagram if there is one. */
function study(found, diagram) {
  const rows = found.points.map((one) => [
    one.method, one.tolerance === null ? withUnit(one.step, "s", 2) : short(one.tolerance, 1),
    one.failure ?? short(one.error, 2), short(one.steps, 4), span(one.seconds),
  ]);
  return element("div", { class: "split" },
    element("section", { class: "panel" }, element("h2", {}, "What accuracy costs"),
      element("p", {}, found.advice ?? "The advice comes when the study is complete."),
      table("Costs", ["Method", "Tolerance or step", "Error", "Steps", "Time"], rows)),
    diagram);
}

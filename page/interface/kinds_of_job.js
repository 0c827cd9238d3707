/** Kinds of jobs as the page offers them: fields, and the document that they make. */

import { ACCURACY, accuracyOf, accurate } from "./accuracy.js";
import { CalibrationFields, NAMES as CALIBRATION } from "./calibration_fields.js";
import { NONE } from "./drawn_parameters.js";
import { formOfKind } from "./form_of_kind.js";
import { linesOf } from "./measured_table.js";
import { ParameterFields } from "./parameter_fields.js";
import { UNKNOWN, fades, sectionFields, sectionGiven, sectionMade } from "./section_fields.js";
import { proposedDuration, rounded } from "./some_duration.js";
import { startNumbers } from "./start_numbers.js";
import { withParameters } from "../mechanism/parameters.js";
import { describedKinds } from "../requests/kinds.js";
import { channels } from "../requests/poses.js";
import { Problem } from "../requests/service.js";

const SAMPLES = 2000; // of a run whose output step is not given

/** Returns what forms propose of a scene as its defaults are: a `duration` in s, and `sections`. */
export async function offers(document, signal) {
  const duration = await proposedDuration(document, signal);
  try {
    return { duration, sections: await channels(withParameters(document), signal) };
  } catch (error) {
    if (!(error instanceof Problem) || error.status === 401) throw error;
    return { duration, sections: UNKNOWN };
  }
}

/** Returns the job that shows a preset with its defaults. */
export async function firstJob(document) {
  return { kind: "simulate", scene: { preset: document.name }, duration: await proposedDuration(document) };
}

/**
 * The kinds by name: what they are, their fields (as declared parameters are described; they take what
 * `offers` returns), the parts of the job's document that are `made` of the values, and the values that
 * are `given` by a job's document.
 */
export const KINDS = {
  simulate: {
    title: "One run",
    help: "One trajectory from the start, to watch and to measure.",
    fields: (document, { duration, sections }) => ({
      duration: {
        title: "Duration", help: "Simulated time.", unit: "s", minimum: 1e-9,
        default: duration,
      },
      accuracy: ACCURACY,
      output_step: {
        title: "Output step", help: `Between stored samples; 1/${SAMPLES} of the duration if empty.`,
        unit: "s", minimum: 1e-15, default: null, empty: `duration / ${SAMPLES}`,
      },
      settle: {
        title: "Settling", help: "What comes before does not count in peaks.", unit: "s",
        minimum: 0, default: 0,
      },
      ...sectionFields(described.simulate.fields.section, sections),
    }),
    made: ({ duration, accuracy, output_step: step, settle, ...all }) => ({
      duration, settle, ...accurate(accuracy), ...(step === null ? {} : { output_step: step }), ...sectionMade(all),
    }),
    given: ({ duration, settle, output_step: step, section, ...job }) => ({
      duration, accuracy: accuracyOf(job), settle, ...sectionGiven(section),
      output_step: Math.abs(step * SAMPLES - duration) < 1e-9 * duration ? null : step,
    }),
  },
  bifurcation: {
    title: "Bifurcation diagram",
    help: "The motion at its sections, such as once a turn, over the values of one parameter.",
    fields: (document, { sections }) => ({
      ...varied(document, "parameter", "Parameter"),
      settle: {
        title: "Periods to settle", help: "Before the first section.", unit: "periods",
        minimum: 0, default: fades(document, sections) ? 0 : 40, whole: true, accepts: ["auto"],
      },
      record: {
        title: "Sections", help: "Kept of each value.", unit: "1", minimum: 1, default: 30, whole: true,
      },
      continuation: {
        title: "Continuation", unit: "1", default: "none",
        help: "Where each value begins: at the scene's start, or where its neighbour ended.",
        choices: ["none", "forward", "backward", "both"],
      },
      verdicts: {
        title: "Regular or chaotic", unit: "1", default: "yes", choices: ["yes", "no"],
        help: "Judge the motion of every value; takes longer.",
      },
      ...sectionFields(described.bifurcation.fields.section, sections),
      accuracy: ACCURACY,
    }),
    made: ({ parameter, from, to, count, settle, record, continuation, verdicts, accuracy, ...all }) => ({
      parameter, values: { from, to, count }, settle, record, continuation, ...sectionMade(all),
      ...(verdicts === "yes" ? { indicators: "all" } : {}), ...accurate(accuracy),
    }),
    given: ({ parameter, values, settle, record, continuation, indicators, section, ...job }) => ({
      parameter, ...ends(values), settle, record, continuation, ...sectionGiven(section),
      verdicts: indicators?.length ? "yes" : "no", accuracy: accuracyOf(job),
    }),
  },
  sweep: {
    title: "Sweep",
    help: "Extremes of forces and motions over one or two parameters.",
    fields: (document, { duration }) => ({
      ...varied(document, "first", "First parameter", { count: 5, place: ({ first }) => `grid/${first}` }),
      ...varied(document, "second", "Second parameter", {
        count: 5, help: "For a map over two parameters.", before: "second", none: true,
        place: ({ second }) => `grid/${second}`,
      }),
      duration: {
        title: "Duration", help: "Of every run.", unit: "s", minimum: 1e-9,
        default: duration,
      },
      periods: {
        title: "Periods", help: "Of every run, instead of a duration.", unit: "periods", minimum: 0,
        default: null, empty: "as the duration says",
      },
      settle: {
        title: "Settling", help: "What comes before does not count.", minimum: 0, default: 0,
        unit: ({ periods }) => (periods ? "periods" : "s"),
      },
      accuracy: ACCURACY,
    }),
    made: (given) => ({
      grid: {
        [given.first]: { from: given.from, to: given.to, count: given.count },
        ...(given.second === NONE ? {} : {
          [given.second]: {
            from: given.second_from, to: given.second_to, count: given.second_count,
          },
        }),
      },
      ...(given.periods ? { periods: given.periods } : { duration: given.duration }),
      settle: given.settle,
      ...accurate(given.accuracy),
    }),
    given: ({ grid, duration, periods, settle, ...job }) => {
      const [first, second] = Object.entries(grid ?? {});
      const other = second && Object.entries(ends(second[1])).map(([name, value]) => [`second_${name}`, value]);
      return {
        ...(first ? { first: first[0], ...ends(first[1]) } : {}),
        ...(second ? { second: second[0], ...Object.fromEntries(other) } : {}),
        ...(periods ? { periods } : { duration }), settle, accuracy: accuracyOf(job),
      };
    },
  },
  "accuracy-study": {
    title: "What accuracy costs",
    help: "Every method and tolerance against a reference.",
    fields: (document, { duration }) => ({
      duration: {
        title: "Duration", help: "Of every run.", unit: "s", minimum: 1e-9,
        default: rounded(duration / 10),
      },
    }),
    made: ({ duration }) => ({ duration }),
    given: ({ duration }) => ({ duration }),
  },
  calibration: {
    title: "Calibration",
    help: "Parameters that give numbers that were measured.",
    made: (all) => all,
    given: ({ parameters, cases, search }) => ({
      find: Object.entries(parameters).map(([name, { minimum, maximum, spacing }]) =>
        `${name}=${minimum}:${maximum}${spacing === "log" ? ":log" : ""}`).join(";"),
      measured: linesOf(cases), generations: search?.generations,
    }),
  },
};

let described = {}; // kinds, as the service does

/** Returns the kinds by name: those above, and of all others those that can be typed. */
export async function kindsOfJobs(signal) {
  described = await describedKinds(signal);
  for (const [name, one] of Object.entries(described)) {
    if (one.option) KINDS[name] ??= formOfKind(name, one, { axis, ends, choice, proposed });
  }
  return KINDS;
}

/**
 * Returns the fields of a kind.
 *
 * @param offered what `offers` returns of the scene
 * @param given   values by name, as an address keeps them
 */
export function fieldsOf(kind, document, offered, given, onchange) {
  if (kind === "calibration") return new CalibrationFields(document, given, onchange);
  return new ParameterFields(KINDS[kind].fields(document, offered), given, onchange, "");
}

/** Returns the names of the fields of a kind, as an address keeps them, whatever is offered of the scene. */
export function namesOfFields(kind, document) {
  if (kind === "calibration") return CALIBRATION;
  return Object.keys(KINDS[kind].fields(document, { duration: null, sections: UNKNOWN }));
}

/**
 * Returns the fields of what varies, and of its values.
 *
 * @param counted help of how many there are
 * @param before begins the names of the fields of its values, and their titles; "": they are the only ones
 * @param place  returns, of the values of all fields, where the range is in the document
 * @param which  see `choice`
 */
function varied(document, name, title, {
  count = 48, help = "What is varied.", counted = "", before = "", place = () => "values", ...which
} = {}) {
  const choices = choice(document, which);
  const part = (end) => (before ? `${before}_${end}` : end);
  const titled = (end) => (before ? `${title}, ${end}` : `${end[0].toUpperCase()}${end.slice(1)}`);
  const proposes = (chosen) => {
    const { from, to } = proposed(document, chosen);
    return { [part("from")]: from, [part("to")]: to };
  };
  const shown = (all) => all[name] !== NONE;
  const end = (one) => ({
    title: titled(one), help: "", shown, pointer: (all) => `${place(all)}/${one}`, unit: (all) => choices.units[all[name]], required: !which.none, empty: "",
    default: proposes(choices.default)[part(one)],
  });
  return {
    [name]: { ...choices, title, help, proposes, pointer: place, once: "varied" },
    [part("from")]: end("from"),
    [part("to")]: end("to"),
    [part("count")]: {
      title: titled("values"), help: counted, shown, pointer: (all) => `${place(all)}/count`,
      unit: "1", minimum: 1, maximum: 100000, default: count, whole: true,
    },
  };
}

/**
 * Returns the fields of an axis, of which there may be several: each proposes another parameter.
 *
 * @param described what the service says of the field
 * @param nth       how many axes come before
 * @param before    see `varied`
 */
function axis(document, name, title, { help, counted, required, varied: of }, nth, before = name) {
  const place = () => (before ? `${name}/values` : "values");
  return varied(document, name, title, { count: 24, help, counted, before, none: !required, of, nth, place });
}

/** Returns the range that is proposed for a parameter, within its own, or for a number of the start. */
function proposed(document, name) {
  if (name === NONE) return { from: null, to: null };
  const start = startNumbers(document)[name];
  return start ? { from: rounded(start.from), to: rounded(start.to) }
    : aboutDefault(document.parameters?.[name] ?? {});
}

function aboutDefault({ default: middle, minimum, maximum }) {
  const [low, high] = [minimum ?? -Infinity, maximum ?? Infinity];
  if (!middle && Number.isFinite(high - low)) return { from: low, to: high };
  const ends = [0.5, 1.5].map((share) => Math.min(Math.max(rounded(share * (middle || 1)), low), high));
  return { from: Math.min(...ends), to: Math.max(...ends) };
}

/** Returns from, to and count of values that are given so, or one by one. */
function ends(values) {
  if (!Array.isArray(values)) return { from: values.from, to: values.to, count: values.count };
  return { from: values[0], to: values.at(-1), count: values.length };
}

/**
 * Returns the field of what varies, with the unit of each choice.
 *
 * @param of   what may: parameters, numbers of the start, or both, those first that are proposed;
 *             none given: parameters
 * @param none whether nothing may, too
 * @param nth  how many others are proposed before
 */
function choice(document, { of = [], none = false, nth = 0 } = {}) {
  const starts = of.includes("start") ? startNumbers(document) : {};
  const parameters = of.length && !of.includes("parameter") ? {} : document.parameters ?? {};
  const numbers = Object.fromEntries(Object.entries(parameters).filter(([, { choices }]) => !choices));
  const all = of[0] === "start" ? { ...starts, ...numbers } : { ...numbers, ...starts };
  const names = Object.keys(all);
  const likely = names.filter((name) => !parameters[name] || parameters[name].default > 0)[nth] ?? names[nth];
  return {
    unit: "1", choices: [...(none ? [NONE] : []), ...names], default: none ? NONE : likely,
    words: Object.fromEntries(Object.entries(starts).map(([pointer, { name }]) => [pointer, `start: ${name}`])),
    units: { [NONE]: "1", ...Object.fromEntries(names.map((name) => [name, all[name].unit])) },
  };
}

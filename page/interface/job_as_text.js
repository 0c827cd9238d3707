/** A job as something to copy: for curl, Python, the command line, and as JSON. */

import { button } from "./button.js";
import { element, fill } from "./element.js";
import { keyHeaders } from "../requests/key.js";

/** Returns tabs with the texts of a job's document; `document()` is asked when they are shown. */
export function jobAsText(document) {
  const text = element("pre", { class: "copied", tabindex: "0", "aria-label": "The same job" });
  const said = element("span", { role: "status", class: "quiet small" });
  let shown = "Python";
  const buttons = Object.keys(FORMS).map((name) =>
    button(name, () => {
      shown = name;
      refresh();
    }, { class: "plain", "aria-pressed": String(name === shown) }));
  const refresh = () => {
    said.textContent = "";
    for (const one of buttons) {
      one.setAttribute("aria-pressed", String(one.textContent === shown));
      one.classList.toggle("chosen", one.textContent === shown);
    }
    try {
      fill(text, FORMS[shown](document()));
    } catch (error) {
      fill(text, error.message);
    }
  };
  const copy = async () => {
    try {
      await navigator.clipboard.writeText(text.textContent);
      said.textContent = "Copied.";
    } catch {
      getSelection().selectAllChildren(text);
      said.textContent = "Selected: press Ctrl+C.";
    }
  };
  refresh();
  const row = element("div", { class: "buttons" }, buttons,
    button("Copy", copy), said);
  return { element: element("div", { class: "stacked" }, row, text), refresh };
}

/** What a job of each kind has found, as the client calls it; of all others their points. */
const FOUND = {
  simulate: "peaks", poincare: "poincare", chart: "dataset", "accuracy-study": "accuracy",
  calibration: "calibration", sensitivity: "sensitivity()", "basin-stability": "attractors",
};
const FORMS = {
  Python: python,
  "Command line": commandLine,
  curl: (job) =>
    `curl -s ${location.origin}/v1/jobs -H 'Content-Type: application/json' ${shownKey()}\\\n  -d ${
      inQuotes(JSON.stringify(job))}`,
  JSON: (job) => JSON.stringify(job, null, 2),
};

/** Returns the option with which curl shows a key, from where the other commands take it; none where none was asked for. */
function shownKey() {
  return keyHeaders().Authorization ? '-H "Authorization: Bearer $JOINTPLAY_KEY" ' : "";
}

function python(job) {
  return `import jointplay

with jointplay.Client("${location.origin}") as client:
    job = client.submit(${literal(job, 4)})
    job.wait(progress=True)
    print(job.${FOUND[job.kind] ?? "points"})`;
}

function literal(value, indent) {
  if (value === null) return "None";
  if (value === true) return "True";
  if (value === false) return "False";
  if (typeof value !== "object") return JSON.stringify(value);
  if (Array.isArray(value)) return `[${value.map((one) => literal(one, indent)).join(", ")}]`;
  const space = " ".repeat(indent + 4);
  const lines = Object.entries(value).map(([key, one]) =>
    `${space}${JSON.stringify(key)}: ${literal(one, indent + 4)},\n`);
  return lines.length ? `{\n${lines.join("")}${" ".repeat(indent)}}` : "{}";
}

const OPTIONS = { duration: "--duration", settle: "--settle", output_step: "--output-step", accuracy: "--accuracy" };

/** Returns a command; of a document with more than it can say, one that takes it from a file. */
function commandLine({ kind, scene, label, ...given }) {
  if (!scene.preset || kind !== "simulate" || Object.keys(given).some((name) => !OPTIONS[name])) {
    return "# save the JSON of this job as job.json, then\njointplay submit job.json --wait";
  }
  const words = [
    ...Object.entries(scene.parameters ?? {}).map(([name, value]) => `--set ${quoted(`${name}=${value}`)}`),
    ...Object.entries(OPTIONS).filter(([name]) => given[name]).map(([name, option]) => `${option} ${quoted(given[name])}`),
    ...(label ? [`--label ${inQuotes(label)}`] : []),
  ];
  return `jointplay submit ${[quoted(scene.preset), ...words].join(" ")} --wait`;
}

/** Returns a word as a shell takes it literally; as it is, where nothing in it means more. */
function quoted(word) {
  return /^[\w.=:@%,+/-]+$/.test(word) ? String(word) : inQuotes(word);
}

function inQuotes(text) {
  return `'${String(text).replaceAll("'", "'\\''")}'`;
}

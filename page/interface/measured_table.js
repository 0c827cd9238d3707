/** Measured numbers as comma-separated lines, and as the cases of a calibration. */

import { typed } from "./numbers.js";

const STATISTICS = ["maximum", "minimum", "range", "maximum_time", "minimum_time"];
const OWN = ["case", "channel", "statistic", "from", "to", "value", "tolerance", "weight", "sampled"];
const NEEDED = ["channel", "to", "value"];

/**
 * Returns `{cases, lines}`: the cases, and by case and target the line that each stands in.
 *
 * @param text lines of a table with a head; columns of other names are parameters of the scene, and
 *   lines with equal ones are one case
 * @param declared parameters of the scene
 * @throws {Error} says in which line something is wrong
 */
export function casesOf(text, declared) {
  const rows = text.split("\n").map((line, i) => [i + 1, line.trim()]).filter(([, line]) => line);
  if (rows.length < 2) throw new Error(`Give a head such as ${NEEDED.join(",")}, and a line for each number.`);
  const cut = (line) => line.split(/[;,\t]/).map((cell) => cell.trim().replace(/^"(.*)"$/, "$1"));
  const [, head] = rows.shift();
  const columns = cut(head);
  const unknown = columns.find((one) => !OWN.includes(one) && !(one in declared));
  if (unknown !== undefined) {
    throw new Error(`Line 1: “${unknown}” is no parameter of the mechanism, and none of ${OWN.join(", ")}.`);
  }
  const missing = NEEDED.find((one) => !columns.includes(one));
  if (missing) throw new Error(`Line 1: a column “${missing}” is needed.`);
  const found = new Map();
  for (const [number, line] of rows) {
    const cells = cut(line);
    if (cells.length !== columns.length) {
      throw new Error(`Line ${number}: ${cells.length} cells, where the head has ${columns.length}.`);
    }
    const row = Object.fromEntries(columns.map((name, i) => [name, cells[i]]));
    const parameters = parametersOf(row, declared, number);
    const key = JSON.stringify([row.case, parameters]);
    if (!found.has(key)) found.set(key, { name: row.case, parameters, targets: [], lines: [] });
    found.get(key).targets.push(targetOf(row, number));
    found.get(key).lines.push(number);
  }
  const all = [...found.values()];
  return {
    cases: all.map(({ name, parameters, targets }) => ({
      ...(name ? { name } : {}), ...(Object.keys(parameters).length ? { parameters } : {}), targets,
    })),
    lines: all.map(({ lines }) => lines),
  };
}

function parametersOf(row, declared, line) {
  const given = Object.entries(row).filter(([name, cell]) => !OWN.includes(name) && cell !== "");
  return Object.fromEntries(given.map(([name, cell]) =>
    [name, declared[name].choices ? cell : numberIn(cell, name, line)]));
}

function targetOf(row, line) {
  const statistic = row.statistic || "maximum";
  if (!STATISTICS.includes(statistic)) {
    throw new Error(`Line ${line}: the statistic is one of ${STATISTICS.join(", ")}.`);
  }
  const optional = { from: "from", tolerance: "absolute_tolerance", weight: "weight", sampled: "sampled" };
  const more = Object.entries(optional).filter(([name]) => row[name])
    .map(([name, field]) => [field, numberIn(row[name], name, line)]);
  const [to, value] = ["to", "value"].map((name) => numberIn(row[name], name, line));
  return { channel: row.channel, statistic, to, value, ...Object.fromEntries(more) };
}

function numberIn(cell, name, line) {
  const value = typed(cell);
  if (Number.isNaN(value)) throw new Error(`Line ${line}: “${cell}” is no number for ${name}.`);
  return value;
}

/** Returns the lines of what a scene's source printed, or of the cases of a calibration. */
export function linesOf(cases) {
  const targets = cases.flatMap(({ name, parameters = {}, targets: some }) => some.map((one) => ({
    case: name, ...parameters, ...one, tolerance: one.absolute_tolerance,
  })));
  const parameters = new Set(cases.flatMap((one) => Object.keys(one.parameters ?? {})));
  const written = (value) => (value === null || value === undefined ? "" : String(value));
  const used = ["case", ...parameters, ...OWN.slice(1)].filter((name) =>
    targets.some((one) => written(one[name]) !== ""));
  return [used, ...targets.map((one) => used.map((name) => written(one[name])))]
    .map((cells) => cells.join(",")).join("\n");
}

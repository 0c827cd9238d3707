/** Measured numbers as comma-separated lines, and as the cases of a calibration. */

import { typed } from "./numbers.js";

const STATISTICS = ["maximum", "minimum", "range", "maximum_time", "minimum_time"];
const OWN = ["case", "channel", "statistic", "from", "to", "value", "lowest", "highest", "tolerance",
  "relative_tolerance", "weight", "sampled", "note"];
const NEEDED = ["channel", "to"];
const VALUES = ["value", "lowest", "highest"]; // one at least
const PARAMETER = "parameter."; // before the name of one that is also that of another column
const NUMBERS = { // further ones, by their fields in the document
  from: "from", tolerance: "absolute_tolerance", relative_tolerance: "relative_tolerance", weight: "weight",
  sampled: "sampled",
};

/**
 * Returns `{cases, lines}`: the cases, and by case and target the line that each stands in.
 *
 * @param text lines of a table with a head; columns of other names are parameters of the scene, and
 *   lines with equal ones are one case. Cells with separators stand in quotation marks
 * @param declared parameters of the scene
 * @throws {Error} says in which line something is wrong
 */
export function casesOf(text, declared) {
  const rows = rowsOf(text);
  if (rows.length < 2) throw new Error(`Give a head such as ${NEEDED.join(",")},value, and a line for each number.`);
  const [, columns] = rows.shift();
  checkHead(columns, declared);
  const found = new Map();
  for (const [number, cells] of rows) {
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

/** Returns `[number of the line, cells]` of the lines of a table in which anything stands. */
function rowsOf(text) {
  const cell = /[^\S\n\t]*(?:"((?:[^"]|"")*)"[^\S\n\t]*|([^,;\t\n]*))([,;\t\n]|$)/y;
  const rows = [];
  let line = 1;
  let row = [line, []];
  for (;;) {
    const [all, quoted, plain, end] = cell.exec(text);
    row[1].push(quoted === undefined ? plain.trim() : quoted.replaceAll('""', '"'));
    line += all.split("\n").length - 1;
    if (end !== "\n" && end !== "") continue;
    if (row[1].some(Boolean)) rows.push(row);
    if (end === "") return rows;
    row = [line, []];
  }
}

function checkHead(columns, declared) {
  const unknown = columns.find((one) => !OWN.includes(one) && !(parameterOf(one) in declared));
  if (unknown !== undefined) {
    throw new Error(`Line 1: “${unknown}” is no parameter of the mechanism, and none of ${OWN.join(", ")}.`);
  }
  const missing = NEEDED.find((one) => !columns.includes(one))
    ?? (VALUES.some((one) => columns.includes(one)) ? undefined : "value");
  if (missing) throw new Error(`Line 1: a column “${missing}” is needed.`);
}

function parameterOf(column) {
  return column.startsWith(PARAMETER) ? column.slice(PARAMETER.length) : column;
}

function parametersOf(row, declared, line) {
  const given = Object.entries(row).filter(([name, cell]) => !OWN.includes(name) && cell !== "")
    .map(([column, cell]) => [parameterOf(column), cell]);
  return Object.fromEntries(given.map(([name, cell]) =>
    [name, declared[name].choices ? cell : numberIn(cell, name, line)]));
}

function targetOf(row, line) {
  const statistic = row.statistic || "maximum";
  if (!STATISTICS.includes(statistic)) {
    throw new Error(`Line ${line}: the statistic is one of ${STATISTICS.join(", ")}.`);
  }
  const more = Object.entries(NUMBERS).filter(([name]) => row[name])
    .map(([name, field]) => [field, numberIn(row[name], name, line)]);
  const to = numberIn(row.to, "to", line);
  return {
    channel: row.channel, statistic, to, ...wantedOf(row, line), ...Object.fromEntries(more),
    ...(row.note ? { note: row.note } : {}),
  };
}

/** Returns the `value` of a line, or the two between which all are as good. */
function wantedOf(row, line) {
  if (!row.lowest && !row.highest) return { value: numberIn(row.value ?? "", "value", line) };
  if (row.value) throw new Error(`Line ${line}: give a value, or what is lowest and highest.`);
  return { between: ["lowest", "highest"].map((name) => (row[name] ? numberIn(row[name], name, line) : null)) };
}

function numberIn(cell, name, line) {
  const value = typed(cell);
  if (Number.isNaN(value)) throw new Error(`Line ${line}: “${cell}” is no number for ${name}.`);
  return value;
}

/** Returns the lines of what a scene's source printed, or of the cases of a calibration. */
export function linesOf(cases) {
  const column = (name) => (OWN.includes(name) ? PARAMETER + name : name);
  const targets = cases.flatMap(({ name, parameters = {}, targets: some }) => some.map((one) => ({
    ...Object.fromEntries(Object.entries(parameters).map(([parameter, value]) => [column(parameter), value])),
    ...one, case: name, tolerance: one.absolute_tolerance, lowest: one.between?.[0], highest: one.between?.[1],
  })));
  const parameters = new Set(cases.flatMap((one) => Object.keys(one.parameters ?? {})).map(column));
  const used = ["case", ...parameters, ...OWN.slice(1)].filter((name) =>
    targets.some((one) => written(one[name]) !== ""));
  return [used, ...targets.map((one) => used.map((name) => written(one[name])))]
    .map((cells) => cells.join(",")).join("\n");
}

/** Returns a cell; what is more than a word stands in quotation marks where it has to. */
function written(value) {
  const text = String(value ?? "");
  return /[,;\t\n"]|^\s|\s$/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

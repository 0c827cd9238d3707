/** Numbers, times and sizes as people read them. */

const PREFIXES = [
  [1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"], [1e-12, "p"],
];
const RAISED = Object.fromEntries([..."-0123456789n"].map((one, i) => [one, [..."⁻⁰¹²³⁴⁵⁶⁷⁸⁹ⁿ"][i]]));
const PREFIXED = new Set(["m", "s", "N", "J", "W", "Pa", "N m", "N s", "Hz"]);
const AXIS_PREFIXES = PREFIXES.filter(([one]) => one <= 1e6 && one >= 1e-9);
const SCALED = /^(m|s|N|J|W|N m|N s|m\/s|m\/s\^2)$/;
const NEVER_LARGER = /^(m|s|rad)(\/s(\^2)?)?$/; // no mechanism is measured in kilometres
const ROUNDING = 1e-14;

/** Returns a number with few digits: 0.0005, 1569, 2.07e+11. */
export function short(value, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text =
    size >= 1e6 || size < 1e-4
      ? value.toExponential(digits - 1)
      : String(Number(value.toPrecision(digits))); // toPrecision alone makes 2.6e+2 of 260
  return text.replace(/(\.\d*?)0+(?=e|$)/, "$1").replace(/\.(?=e|$)/, "").replaceAll("-", "−");
}

/** Returns a unit with its exponents raised: m/s². */
export function unitText(unit) {
  return unit.replace(/\^(-?\d+|n)(?![\d.])/g, (_, power) => raised(power));
}

function raised(power) {
  return [...power].map((one) => RAISED[one]).join("");
}

/** Returns a value with its unit and a prefix that suits it: 0.5 mm, 1.57 kN, 3.14 rad/s. */
export function withUnit(value, unit, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (unit === "1" || !unit) return short(value, digits);
  if (!PREFIXED.has(unit) || value === 0) return `${short(value, digits)} ${unitText(unit)}`;
  const [factor, prefix] =
    PREFIXES.find(([one]) => Math.abs(value) >= one * 0.9995) ?? [1, ""];
  return `${short(value / factor, digits)} ${prefix}${unit}`;
}

/** Returns a value with its standard error, to the digits that the error leaves: 2.6 ± 1.2. */
export function withError(value, error) {
  if (!(error > 0)) return `${short(value)} ± ${short(error)}`;
  const [size, last] = [value, error].map((one) => Math.floor(Math.log10(Math.abs(one))));
  const digits = size - last + 2;
  return `${short(value, Math.min(Math.max(digits, 1), 9))} ± ${short(error, 2)}`;
}

/** Returns what one of an axis's unit is in SI, and the unit with its prefix or factor, as figures have it. */
export function axisUnit(unit, largest) {
  const plain = [1, unit === "1" ? "" : unitText(unit)];
  if (!(largest > 0) || (largest >= 0.1 && largest < 1e4)) return plain;
  if (largest >= 1e4 && NEVER_LARGER.test(unit)) {
    const thousands = 3 * Math.floor(Math.log10(largest) / 3);
    return [10 ** thousands, `10${raised(String(thousands))} ${plain[1]}`];
  }
  if (!SCALED.test(unit)) return plain;
  const [one, prefix] = AXIS_PREFIXES.find(([factor]) =>
    largest >= (factor > 1 ? factor : 0.1 * factor)) ?? AXIS_PREFIXES.at(-1);
  return [one, prefix + unitText(unit)];
}

/** Returns the label of an axis; that of a pure number has no brackets. */
export function axisLabel(name, unit) {
  return unit ? `${name} [${unit}]` : name;
}

/** Returns `[value, text]` of ascending numbers along an axis, with digits that tell them apart. */
export function apart(values) {
  const steps = values.length * Math.max(...values.map(Math.abs)) / (values.at(-1) - values[0]);
  const digits = Number.isFinite(steps) ? Math.max(4, Math.ceil(Math.log10(steps)) + 1) : 4;
  return values.map((value) => [value, short(value, digits)]);
}

/** Returns a span of seconds for people: 0.3 s, 2 min 5 s, 3 h 20 min. */
export function span(seconds) {
  if (seconds === null || seconds === undefined) return "–";
  if (seconds < 0.95) return withUnit(seconds, "s", 2);
  if (seconds < 60) return `${short(seconds, 2)} s`;
  const whole = Math.round(seconds);
  if (whole < 3600) return `${Math.floor(whole / 60)} min ${whole % 60} s`;
  if (whole < 172800) return `${Math.floor(whole / 3600)} h ${Math.floor((whole % 3600) / 60)} min`;
  return `${Math.round(whole / 86400)} days`;
}

/** Returns a value, or 0 where it is rounding beside another of the same channel: a crank at 90°. */
export function notRounding(value, beside) {
  return value !== null && Math.abs(value) <= ROUNDING * Math.abs(beside) ? 0 : value;
}

/** Returns a size in bytes for people: 820 kB, 1.2 GB. */
export function bytes(count) {
  for (const [factor, prefix] of PREFIXES.slice(0, 3)) {
    if (count >= factor) return `${short(count / factor, 3)} ${prefix}B`;
  }
  return `${count} B`;
}

/** Returns how long ago a moment is: "just now", "5 min ago". */
export function ago(moment) {
  const seconds = (Date.now() - Date.parse(moment)) / 1000;
  return seconds < 10 ? "just now" : `${span(seconds).replace(/ min \d+ s/, " min")} ago`;
}

/** What is said where `typed` finds none. */
export const NO_NUMBER = "This is no number; 0.0005 and 5e-4 are.";

/** Returns a number that was typed, with a decimal point or comma; NaN if it is none. */
export function typed(text) {
  const trimmed = text.trim().replace("−", "-").replace(/^([^.]*),([^,.]*)$/, "$1.$2");
  return /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(trimmed) ? Number(trimmed) : NaN;
}

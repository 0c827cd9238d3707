/** Where a motion is converged, as its certificate has it in spans: one story for every view. */

import { span, withUnit } from "./numbers.js";

const TOLD = 3; // spans in one sentence
const ROUNDING = 1e-9;

/** Returns the [first, last] times, s, of a stretch in which the motion is not converged. */
export function gaps(certificate, first, last) {
  const found = [];
  let reached = first;
  for (const [begin, end] of certificate?.converged ?? [[first, last]]) {
    if (begin > reached) found.push([reached, Math.min(begin, last)]);
    reached = Math.max(reached, end);
  }
  found.push([reached, last]);
  return found.filter(([begin, end]) => end - begin > ROUNDING * last);
}

/** Returns spans in words, with the number of those that are left out. */
export function spansInWords(spans) {
  const words = spans.slice(0, TOLD).map(([begin, end]) =>
    `${withUnit(begin, "s", 3)} to ${withUnit(end, "s", 3)}`);
  const more = spans.length - words.length;
  return words.join(", ") + (more > 0 ? ` and ${more} more` : "");
}

/** Returns sentences on where a run's curve can be trusted, and how small differences grow. */
export function convergence(certificate, duration) {
  const apart = gaps(certificate, 0, duration);
  const known = certificate.converged.filter(([begin, end]) => end > begin);
  return [course(apart, known), growth(certificate, apart)].filter(Boolean);
}

function course(apart, known) {
  if (!apart.length) return "Trust the whole curve: another tolerance gives the same motion.";
  if (!known.length) {
    return "Do not trust the course of the curve: no part of it is shown to be converged.";
  }
  return `Trust the curve from ${spansInWords(known)}. From ${spansInWords(apart)} other tolerances`
    + " take other paths: trust the statistics there.";
}

function growth({ exponent, exponent_note: note }, apart) {
  if (!exponent) return note;
  const { value, error } = exponent;
  if (value > 2 * (error ?? 0)) {
    return `Small differences grow tenfold every ${span(Math.log(10) / value)}: the motion is chaotic`
      + " or close to it.";
  }
  return apart.length
    ? "Small differences show no lasting growth, though they grow for a while: the motion is regular"
      + " as far as this run tells."
    : "Small differences do not grow: the motion is regular as far as this run tells.";
}

/** Of channels at sections, the first that tells something: others are the same at all of them. */

import { intoATurn } from "./turns.js";

const ALIKE = 1e-6; // share of the largest value in this unit within which values are the same
const TURN = 2 * Math.PI;

/**
 * Returns the name of the first channel whose values are not all alike; null: those of none.
 *
 * A body that falls straight down is beside its path by rounding alone, and a crank is where it was after
 * each turn.
 *
 * @param channels `{name: {unit, values}}`, with `values` in lists of lists, as `/poincare` answers
 */
export function telling(channels) {
  const all = Object.entries(channels).map(([name, { unit, values }]) => {
    const found = values.flat(Infinity).filter(Number.isFinite);
    return { name, unit, values: unit === "rad" ? found.map(intoATurn(found)) : found };
  });
  const largest = { rad: TURN };
  for (const { unit, values } of all) {
    if (unit !== "rad") largest[unit] = values.reduce((most, one) => Math.max(most, Math.abs(one)), largest[unit] ?? 0);
  }
  return all.find(({ unit, values }) => {
    const [low, high] = values.reduce(([least, most], one) => [Math.min(least, one), Math.max(most, one)],
      [Infinity, -Infinity]);
    return high - low > ALIKE * largest[unit];
  })?.name ?? null;
}

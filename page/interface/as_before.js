/** A job that is like an earlier one but for what was changed in its form. */

/**
 * Returns the document of the changed job.
 *
 * A form shows less than a document can say: of values one by one their ends and their number, of a
 * grid two parameters.  What it would make of the earlier job, and still makes, is therefore as in
 * the earlier document; and so is what it has no fields for.
 *
 * @param before document of the earlier job, or a part of it
 * @param made   what the form makes of the values that the earlier job gives
 * @param now    what it makes of its values now
 */
export function asBefore(before, made, now) {
  if (!same([made.accuracy, made.tolerance], [now.accuracy, now.tolerance])) {
    before = without(before, ["method", "step"]); // a named accuracy has a method of its own
  }
  const found = {};
  for (const key of new Set([...Object.keys(before), ...Object.keys(now)])) {
    if (same(made[key], now[key])) found[key] = key in before ? before[key] : now[key];
    else if ([before, made, now].every((one) => isObject(one[key]))) {
      found[key] = asBefore(before[key], made[key], now[key]);
    } else if (key in now) found[key] = now[key];
  }
  return found;
}

/** Returns a document without the fields that a form has but leaves to the service. */
export function without(document, fields) {
  return Object.fromEntries(Object.entries(document).filter(([key]) => !fields.includes(key)));
}

function isObject(value) {
  return value !== null && typeof value === "object" && !Array.isArray(value);
}

function same(one, other) {
  return JSON.stringify(one) === JSON.stringify(other);
}

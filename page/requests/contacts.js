/** Contacts of a run: all of them, or the first where they are more than one answer carries. */

import { Problem, get } from "./service.js";

const ENOUGH = 200; // contacts, where not all can be had
const TRIES = 24;

/**
 * Returns `{impacts, until}`: the contacts, and the time in s up to which they are all; null: to the end.
 *
 * @param path of the contacts
 * @param seconds that the run takes
 */
export async function contacts(path, seconds, signal) {
  let found = await within(path, {}, signal);
  if (found) return { impacts: found, until: null };
  let [few, many] = [0, seconds];
  found = [];
  for (let tried = 0; tried < TRIES && found.length < ENOUGH; tried += 1) {
    const middle = (few + many) / 2;
    const answer = await within(path, { stop: middle }, signal);
    if (answer) [few, found] = [middle, answer];
    else many = middle;
  }
  return { impacts: found, until: few };
}

/** Returns the contacts of a window; null: they are too many for an answer. */
async function within(path, window, signal) {
  try {
    return (await get(path, window, signal)).impacts;
  } catch (error) {
    if (error instanceof Problem && error.type.endsWith("/response-too-large")) return null;
    throw error;
  }
}

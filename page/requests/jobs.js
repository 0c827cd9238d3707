/** Jobs by their ids, of which some may be gone. */

import { get } from "./service.js";

const GONE = [404, 410];

/** Returns a job as the service shows it; null: there is none any more. */
export async function jobIfThere(id, signal) {
  try {
    return await get(`/v1/jobs/${encodeURIComponent(id)}`, {}, signal);
  } catch (error) {
    if (GONE.includes(error.status)) return null;
    throw error;
  }
}

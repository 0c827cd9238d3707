/** The scene of a job as it was run: the preset or the job's own document, parameters set. */

import { withParameters } from "../mechanism/parameters.js";
import { get } from "../requests/service.js";

/** Returns the scene document of a job's document. */
export async function sceneOf({ scene }, signal) {
  if (!scene.preset) {
    const values = Object.fromEntries(Object.entries(scene.parameters ?? {})
      .filter(([, value]) => value === null || typeof value !== "object"));
    return withParameters(scene, values);
  }
  const document = await get(`/v1/scenes/${encodeURIComponent(scene.preset)}`, {}, signal);
  return withParameters(document, scene.parameters);
}

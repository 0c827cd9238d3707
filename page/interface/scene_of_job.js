/** The scene of a job as it was run: the preset or the job's own document, parameters set. */

import { withParameters } from "../mechanism/parameters.js";
import { get } from "../requests/service.js";

const presets = new Map(); // they belong to the service's version

/** Returns the document of a scene that is shipped; it is asked for once. */
export function preset(name) {
  if (!presets.has(name)) {
    const asked = get(`/v1/scenes/${encodeURIComponent(name)}`);
    presets.set(name, asked);
    asked.catch(() => presets.delete(name));
  }
  return presets.get(name);
}

/** Returns the scene document of a job's document. */
export async function sceneOf({ scene }) {
  if (!scene.preset) {
    const values = Object.fromEntries(Object.entries(scene.parameters ?? {})
      .filter(([, value]) => value === null || typeof value !== "object"));
    return withParameters(scene, values);
  }
  return withParameters(await preset(scene.preset), scene.parameters);
}

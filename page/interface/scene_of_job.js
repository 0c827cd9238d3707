/** The scene of a job as it was run: the preset or the job's own document, parameters set. */

import { withParameters } from "../mechanism/parameters.js";
import { marks } from "../mechanism/placing.js";
import { poses } from "../requests/poses.js";
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

/** Returns the same with the curves of its joints; without them where the service is away. */
export async function drawnSceneOf(job, signal) {
  const scene = await sceneOf(job);
  if (!Object.values(scene.joints).some((joint) => marks(joint).has_curves)) return scene;
  const { curves } = await poses(scene, [0], signal).catch(() => ({ curves: [] }));
  return { ...scene, curves };
}

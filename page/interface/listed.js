/** A job as a list keeps it: ten thousand of them are some megabytes. */

const MOST_PARAMETERS = 6;

/** Returns what a row shows of a job, without its document. */
export function listed(job) {
  const { scene, duration } = job.job;
  const parameters = Object.fromEntries(Object.entries(scene?.parameters ?? {})
    .filter(([, value]) => typeof value === "number").slice(0, MOST_PARAMETERS));
  const { id, kind, label, state, activity, progress, created, started, finished, error } = job;
  return {
    id, kind, label, state, activity, progress, created, started, finished, error,
    job: { kind, duration, scene: { preset: scene?.preset, name: scene?.name, parameters } },
  };
}

/** Kinds of jobs as the service describes them; asked for once. */

import { get } from "./service.js";

let known = null;

/** Returns by name what each kind is, its fields, and how a command line asks for it. */
export async function describedKinds(signal) {
  known ??= (await get("/v1/kinds", {}, signal)).kinds;
  return known;
}

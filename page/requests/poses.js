/** Poses of a scene before it is run, as the solver puts it together and follows it; and its channels. */

import { patiently, untilAnswered } from "./patiently.js";
import { post } from "./service.js";

let turn = Promise.resolve();

/**
 * Returns what `POST /v1/scenes/poses` answers; requests of a page are sent one after the other.
 *
 * @param scene the scene document, its parameters set
 * @param times instants, s
 */
export function poses(scene, times, signal) {
  return inTurn("/v1/scenes/poses", { scene: plain(scene), times }, signal);
}

/** Returns what `POST /v1/scenes/channels` answers: channels, contacts, and sections that suit. */
export function channels(scene, signal) {
  return inTurn("/v1/scenes/channels", { scene: plain(scene) }, signal);
}

function inTurn(address, question, signal) {
  const once = () => patiently(() => post(address, question, signal), signal);
  const ask = () => untilAnswered(once, signal, { away: true });
  const answer = turn.then(ask, ask);
  turn = answer.catch(() => {});
  return answer;
}

/** Returns the pose in which a point `body.point` is pulled to a position `[x, y]` from another pose. */
export async function dragged(scene, pose, point, position, signal) {
  return (await post("/v1/scenes/drag", { scene: plain(scene), pose, point, position }, signal)).pose;
}

/** Returns a scene without what was declared for it, as its parameters are set, and its curves. */
function plain({ parameters, reported, curves, ...scene }) {
  return scene;
}

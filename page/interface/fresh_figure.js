/** A figure of a job that may still run: asked for anew, for a browser shows what it has of an address. */

import { openAddress } from "../requests/key.js";
import { element } from "./element.js";

/** Returns the picture at a path of the service, once it is here: the one before stays in sight until then. */
export async function freshFigure(path, alt) {
  return element("img", {
    class: "figure", alt, src: await openAddress(path, true), onload: ({ target }) => URL.revokeObjectURL(target.src),
  });
}

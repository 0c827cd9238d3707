/** Completion and hover help from the schema of a scene. */

import { autocompletion, hoverTooltip } from "../vendor/codemirror/codemirror.js";
import { element } from "../interface/element.js";
import { MARKS } from "../mechanism/joint_marks.js";
import { pathAt, siblings } from "./pointers.js";

/**
 * Returns the extensions of an editor.
 *
 * @param schema a `SceneSchema`
 * @param document returns the last document that could be parsed
 */
export function help(schema, document) {
  return [
    autocompletion({ override: [(context) => completions(context, schema, document())] }),
    hoverTooltip((view, position) => hover(view, position, schema, document())),
  ];
}

function completions(context, schema, document) {
  const { state, pos } = context;
  const word = context.matchBefore(/"[\w-]*"?|[\w-]+/);
  if (!word && !context.explicit) return null;
  const from = word?.from ?? pos;
  const before = state.sliceDoc(Math.max(0, from - 200), from).trimEnd();
  const { keys } = pathAt(state, from + (word ? 1 : 0));
  if (before.endsWith(":") || before.endsWith("[")) {
    const words = [...schema.words(keys, document), ...references(keys, document)];
    return words.length ? { from, options: words.map((one) => ({ label: JSON.stringify(one) })) } : null;
  }
  const { atName } = pathAt(state, from + 1);
  const parent = atName ? keys.slice(0, -1) : keys;
  const taken = new Set(siblings(state, from));
  const options = schema.properties(parent, document)
    .filter(([name]) => !taken.has(name))
    .map(([name, property, required]) => ({
      label: JSON.stringify(name),
      apply: `${JSON.stringify(name)}: `,
      detail: [property.unit, required && "required"].filter(Boolean).join(", "),
      info: property.description,
      boost: required ? 1 : 0,
    }));
  return options.length ? { from, options } : null;
}

const POINTS = new Set([...Object.values(MARKS).flatMap(({ ends }) => ends), "first", "second"]);

/** References `body.point` and names of joints, where they are wanted. */
function references(keys, document) {
  const key = keys.at(-1);
  if (key === "joint") return Object.keys(document.joints ?? {});
  if (!POINTS.has(key)) return [];
  const bodies = { ground: document.ground, ...document.bodies };
  return Object.entries(bodies).flatMap(([body, one]) =>
    Object.keys(one?.points ?? {}).map((point) => `${body}.${point}`));
}

function hover(view, position, schema, document) {
  const { keys } = pathAt(view.state, position);
  if (!keys.length) return null;
  const lines = schema.about(keys, document);
  if (!lines.length) return null;
  return {
    pos: position,
    create: () => ({
      dom: element("div", { class: "help-tip" }, element("strong", {}, keys.at(-1)),
        lines.map((line) => element("div", {}, line))),
    }),
  };
}

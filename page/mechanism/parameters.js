/** Declared parameters of a scene: from values to the places in the document that they name. */

/** Returns a copy of a scene document with its parameters set; later ones override earlier ones. */
export function withParameters(document, values = {}) {
  const filled = structuredClone(document);
  for (const [name, parameter] of Object.entries(document.parameters ?? {})) {
    const value = values[name] ?? parameter.default;
    if (value === null || value === undefined) continue;
    for (const { path, factor = 1 } of parameter.targets) {
      put(filled, path, typeof value === "number" ? value * factor : value);
    }
  }
  return filled;
}

/** Returns a copy of a scene document whose parameters have other defaults: it has no values beside it. */
export function withDefaults(document, values) {
  const declared = Object.entries(document.parameters ?? {}).map(([name, parameter]) =>
    [name, name in values ? { ...parameter, default: values[name] } : parameter]);
  return declared.length ? { ...document, parameters: Object.fromEntries(declared) } : document;
}

function put(node, path, value) {
  const keys = path.split("/").slice(1);
  const last = keys.pop();
  for (const key of keys) {
    node = node?.[key];
    if (node === null || typeof node !== "object") return;
  }
  if (node !== undefined) node[last] = value;
}

/** The document that a JSON text is, or what keeps it from being one. */

const TOKEN = /"(?:[^"\\]|\\.)*"(\s*:)?|[{}]/g;

/** A text that is no document; `faults` says where: `{from, to, detail}` of each. */
export class NoDocument extends Error {
  constructor(faults) {
    super(faults[0].detail);
    this.faults = faults;
  }
}

/** Returns the document; throws NoDocument. */
export function documentIn(text) {
  let document;
  try {
    document = JSON.parse(text);
  } catch (error) {
    const at = Number(/position (\d+)/.exec(error.message)?.[1] ?? 0);
    const [from, to] = [at, at + 1].map((one) => Math.min(one, text.length));
    throw new NoDocument([{ from, to, detail: error.message }]);
  }
  const again = twice(text);
  if (again.length) throw new NoDocument(again);
  return document;
}

/** Returns the faults of keys that their object has had before: JSON.parse keeps the last alone. */
function twice(text) {
  const objects = [];
  const found = [];
  for (const { 0: token, 1: colon, index: from } of text.matchAll(TOKEN)) {
    if (token === "{") objects.push(new Set());
    else if (token === "}") objects.pop();
    else if (colon !== undefined) {
      const written = token.slice(0, token.length - colon.length);
      const key = JSON.parse(written);
      const detail = `The key '${key}' is given twice; give it once.`;
      if (objects.at(-1).has(key)) found.push({ from, to: from + written.length, detail });
      objects.at(-1).add(key);
    }
  }
  return found;
}

/** The JSON Schema of a scene: what stands at a place, what may stand there, and what it means. */

import { short } from "../interface/numbers.js";

export class SceneSchema {
  /** @param schema as the service gives it */
  constructor(schema) {
    this.schema = schema;
  }

  /** Returns the schemas that may hold at a path of keys, given the document so far. */
  at(keys, document) {
    let found = this.resolved(this.schema, document);
    let value = document;
    for (const key of keys) {
      value = value?.[key];
      found = found.flatMap((one) => this.inside(one, key)).flatMap((one) => this.resolved(one, value));
    }
    return found;
  }

  /** Returns the properties that an object at a path may have: `[name, schema, required]`. */
  properties(keys, document) {
    const seen = new Map();
    for (const one of this.at(keys, document)) {
      for (const [name, property] of Object.entries(one.properties ?? {})) {
        seen.set(name, [name, property, (one.required ?? []).includes(name)]);
      }
    }
    return [...seen.values()];
  }

  /** Returns the words that may stand at a path. */
  words(keys, document) {
    const found = this.at(keys, document).flatMap((one) => [
      ...(one.enum ?? []), ...("const" in one ? [one.const] : []),
      ...(one.type === "boolean" ? [true, false] : []),
      ...(one.type === "null" ? [null] : []),
    ]);
    const parents = this.unresolved(keys.slice(0, -1), document);
    const mapped = parents.flatMap((one) =>
      one.discriminator?.propertyName === keys.at(-1) ? Object.keys(one.discriminator.mapping) : []);
    return [...new Set([...found, ...mapped])];
  }

  /** Returns what a place is about, as lines of text. */
  about(keys, document) {
    const [key] = keys.slice(-1);
    const [, property] = this.properties(keys.slice(0, -1), document)
      .find(([name]) => name === key) ?? [];
    const some = [property, ...this.at(keys, document)].filter(Boolean);
    const text = some.map(({ description }) => description).find(Boolean);
    const range = some.map(rangeWords).find(Boolean);
    return [text, range].filter(Boolean);
  }

  unresolved(keys, document) {
    let found = [this.schema];
    let value = document;
    for (const key of keys) {
      found = found.flatMap((one) => this.resolved(one, value)).flatMap((one) => this.inside(one, key));
      value = value?.[key];
    }
    return found.flatMap((one) => this.references(one)).flatMap((one) =>
      [one, ...(one.anyOf ?? []), ...(one.oneOf ?? [])]).flatMap((one) => this.references(one));
  }

  references(schema) {
    if (!schema.$ref) return [schema];
    return [this.schema.$defs[schema.$ref.split("/").at(-1)] ?? {}];
  }

  /** Follows references and choices; a discriminator or a shared property chooses. */
  resolved(schema, value) {
    if (!schema || typeof schema !== "object") return [];
    if (schema.$ref) return this.references(schema).flatMap((one) => this.resolved(one, value));
    const { discriminator } = schema;
    const chosen = discriminator && value?.[discriminator.propertyName];
    if (chosen && discriminator.mapping[chosen]) {
      return this.resolved({ $ref: discriminator.mapping[chosen] }, value);
    }
    const choices = [...(schema.anyOf ?? []), ...(schema.oneOf ?? []), ...(schema.allOf ?? [])];
    return choices.length ? choices.flatMap((one) => this.resolved(one, value)) : [schema];
  }

  inside(schema, key) {
    if (schema.properties?.[key]) return [schema.properties[key]];
    const patterns = Object.values(schema.patternProperties ?? {});
    if (patterns.length) return patterns;
    if (typeof schema.additionalProperties === "object") return [schema.additionalProperties];
    if (schema.prefixItems?.[key]) return [schema.prefixItems[key]];
    return schema.items ? [schema.items] : [];
  }
}

/** Returns type, range, unit and default of a number, or of what has one; else nothing. */
export function rangeWords(schema) {
  const parts = [];
  if (schema.type) parts.push([schema.type].flat().join(" or "));
  const unit = schema.unit && schema.unit !== "1" ? ` ${schema.unit}` : "";
  const { minimum, maximum, exclusiveMinimum: above, exclusiveMaximum: below } = schema;
  if (above !== undefined) parts.push(`above ${short(above)}${unit}`);
  if (minimum !== undefined) parts.push(`at least ${short(minimum)}${unit}`);
  if (maximum !== undefined) parts.push(`at most ${short(maximum)}${unit}`);
  if (below !== undefined) parts.push(`below ${short(below)}${unit}`);
  if (parts.length < 2 && unit) parts.push(`in${unit}`);
  if (schema.default !== undefined && typeof schema.default !== "object") {
    parts.push(`default ${schema.default}`);
  }
  return parts.length > 1 || unit ? parts.join(", ") : "";
}

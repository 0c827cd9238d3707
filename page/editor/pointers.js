/** JSON pointers of a text: from a position to its pointer, and back, by the syntax tree. */

import { syntaxTree } from "../vendor/codemirror/codemirror.js";

/** Returns the keys that lead to a position, and whether it is at a property's name. */
export function pathAt(state, position) {
  let node = syntaxTree(state).resolveInner(position, -1);
  const atName = node.name === "PropertyName";
  const keys = [];
  for (; node; node = node.parent) {
    if (node.name === "Property") keys.unshift(keyOf(state, node));
    else if (node.parent?.name === "Array") keys.unshift(indexOf(node));
  }
  return { keys, atName };
}

/** Returns `{from, to}` of the value at a JSON pointer, or of the nearest thing around it. */
export function rangeAt(state, pointer) {
  let node = syntaxTree(state).topNode.firstChild;
  let range = { from: 0, to: Math.min(1, state.doc.length) };
  for (const key of pointer.split("/").slice(1)) {
    const name = key.replaceAll("~1", "/").replaceAll("~0", "~");
    const inside = node?.name === "Object" ? property(state, node, name) : element(node, Number(name));
    if (!inside) break;
    node = inside.value;
    range = { from: inside.from, to: inside.to };
  }
  return range;
}

/** Names of the properties of the object around a position. */
export function siblings(state, position) {
  let node = syntaxTree(state).resolveInner(position, -1);
  while (node && node.name !== "Object") node = node.parent;
  return node ? children(node, "Property").map((one) => keyOf(state, one)) : [];
}

function keyOf(state, node) {
  const name = node.getChild("PropertyName");
  const text = name ? state.sliceDoc(name.from, name.to) : '""';
  try {
    return JSON.parse(text);
  } catch {
    return text.replaceAll('"', "");
  }
}

function property(state, node, name) {
  const found = children(node, "Property").find((one) => keyOf(state, one) === name);
  if (!found) return null;
  const value = found.lastChild;
  const key = found.getChild("PropertyName");
  return { value, from: value.name === "Object" ? key.from : value.from, to: value.name === "Object" ? key.to : value.to };
}

function element(node, index) {
  if (node?.name !== "Array") return null;
  const value = children(node).filter((one) => !"[],".includes(one.name))[index];
  return value ? { value, from: value.from, to: value.to } : null;
}

function indexOf(node) {
  let index = 0;
  for (let one = node.prevSibling; one; one = one.prevSibling) if (!"[],".includes(one.name)) index += 1;
  return String(index);
}

function children(node, name) {
  const found = [];
  for (let one = node.firstChild; one; one = one.nextSibling) {
    if (!name || one.name === name) found.push(one);
  }
  return found;
}

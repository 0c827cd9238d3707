/** Makes elements; texts stay texts, whatever they contain. */

const SVG = "http://www.w3.org/2000/svg";

/**
 * Returns an element with attributes, listeners (`onclick`) and children.
 *
 * Values `null`, `undefined` and `false` leave an attribute or a child out; `true` gives an
 * attribute without a value. Children are elements, or anything that is written as a text.
 */
export function element(tag, attributes = {}, ...children) {
  return filled(document.createElement(tag), attributes, children);
}

/** Returns an element of an SVG picture. */
export function svgElement(tag, attributes = {}, ...children) {
  return filled(document.createElementNS(SVG, tag), attributes, children);
}

/** Replaces everything that an element contains. */
export function fill(parent, ...children) {
  parent.replaceChildren(...children.flat(Infinity).filter(isShown));
}

function filled(made, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (name in PROPERTIES) made[name] = value;
    else made.setAttribute(name, value === true ? "" : value);
  }
  made.append(...children.flat(Infinity).filter(isShown));
  return made;
}

const PROPERTIES = { value: 1, checked: 1, disabled: 1, hidden: 1, selected: 1, indeterminate: 1 };

function isShown(child) {
  return child !== null && child !== undefined && child !== false;
}

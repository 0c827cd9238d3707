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

/** Replaces all of it by what is there by now: what had the keyboard, and is there still, has it again. */
export function refill(parent, ...children) {
  const kept = parent.contains(document.activeElement) ? known(document.activeElement) : null;
  const scrolled = [...parent.querySelectorAll(".wide")].map(({ scrollLeft }) => scrollLeft);
  fill(parent, ...children);
  parent.querySelectorAll(".wide").forEach((one, place) => (one.scrollLeft = scrolled[place] ?? 0));
  if (kept) [...parent.querySelectorAll(kept.tag)].find((one) => known(one).text === kept.text)?.focus({ preventScroll: true });
}

/** Returns what an element is known by, also when it was made anew. */
function known(one) {
  const said = one.getAttribute("aria-label") ?? one.textContent;
  return { tag: one.tagName, text: one.id || `${one.getAttribute("href")} ${said}` };
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

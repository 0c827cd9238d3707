/** What the address keeps of a form: parameters of the mechanism, apart from the fields of the form. */

const PARAMETER = "parameter."; // no field of a form has a point in its name
const OF_EVERY_FORM = ["kind", "label", "job"];

/** Returns values of parameters by the names that an address has for them. */
export function ofParameters(values) {
  return Object.fromEntries(Object.entries(values).map(([name, value]) => [PARAMETER + name, value]));
}

/**
 * Returns `{parameters, fields}`: what an address gives of a mechanism's parameters, and of a form's fields.
 *
 * A parameter may also stand under its own name, unless that is the name of a field.
 *
 * @param query    the address' `URLSearchParams`
 * @param declared parameters of the mechanism
 * @param names    of the fields of the form
 */
export function inAddress(query, declared, names) {
  const own = new Set([...OF_EVERY_FORM, ...names]);
  const found = { parameters: {}, fields: {} };
  for (const [written, text] of query) {
    const name = written.startsWith(PARAMETER) ? written.slice(PARAMETER.length) : written;
    const isParameter = Object.hasOwn(declared, name) && (name !== written || !own.has(name));
    const { choices } = (isParameter && declared[name]) || {};
    const word = choices || text.trim() === "" || Number.isNaN(Number(text));
    const value = word ? text : Number(text);
    if (!isParameter) found.fields[written] = value;
    else if (name !== written || !Object.hasOwn(found.parameters, name)) found.parameters[name] = value;
  }
  return found;
}

/** Where the reader is: the view and what it shows, as the address says after `#`. */

/** Returns the view, its further parts and its query: `#/job/ID?time=0.3`. */
export function route(hash = location.hash) {
  const [path, query] = hash.replace(/^#\/?/, "").split("?");
  const [view, ...parts] = path.split("/").map(decoded);
  return { view: view || "start", parts, query: new URLSearchParams(query ?? "") };
}

/** Returns the address of a view: `address(["job", id], {time: 0.3})`. */
export function address(parts, query = {}) {
  const given = Object.entries(query).filter(([, v]) => v !== null && v !== undefined && v !== "");
  const text = new URLSearchParams(given).toString();
  return `#/${parts.map(encodeURIComponent).join("/")}${text ? `?${text}` : ""}`;
}

/** Notes something in the address without leaving the view, or an entry in the browser's history. */
export function note(query) {
  const here = route();
  for (const [name, value] of Object.entries(query)) {
    if (value === null || value === undefined || value === "") here.query.delete(name);
    else here.query.set(name, value);
  }
  const parts = here.view === "start" && !here.parts.length ? [] : [here.view, ...here.parts];
  history.replaceState(null, "", address(parts, Object.fromEntries(here.query)));
}

/** Forgets all that the address notes of the view. */
export function forget() {
  note(Object.fromEntries([...route().query.keys()].map((name) => [name, null])));
}

/** Goes to a view. */
export function go(parts, query = {}) {
  location.hash = address(parts, query);
}

function decoded(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

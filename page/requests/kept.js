/** Texts that are kept until the tab is closed; until the page is left where its storage is full or forbidden. */

const here = new Map();

/** Keeps a text by its name. */
export function keep(name, text) {
  here.set(name, text);
  try {
    sessionStorage.removeItem(name); // what does not fit leaves none that is older
    sessionStorage.setItem(name, text);
  } catch {
    // it is kept by the page alone
  }
}

/** Returns the text that was kept; null: none was. */
export function kept(name) {
  if (here.has(name)) return here.get(name);
  try {
    return sessionStorage.getItem(name);
  } catch {
    return null;
  }
}

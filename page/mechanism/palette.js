/** Colours of drawings, as the style sheet gives them for light and dark surroundings. */

const NAMES = [
  "paper", "ink", "quiet", "faint", "edge", "ground", "play", "force", "trail", "accent",
  "tint-0", "tint-1", "tint-2", "tint-3", "tint-4", "tint-5",
  "curve-0", "curve-1", "curve-2", "curve-3",
  "backward", "periodic", "quasi-periodic", "chaotic", "equilibrium", "undecided",
];
const dark = matchMedia("(prefers-color-scheme: dark)");
let known = null;
dark.addEventListener("change", () => (known = null));

/** Returns colours by name. */
export function palette() {
  if (known === null) {
    const style = getComputedStyle(document.documentElement);
    known = Object.fromEntries(
      NAMES.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]),
    );
  }
  return known;
}

/** Calls `redraw` whenever the colours change, until `signal` is aborted. */
export function onNewColours(redraw, signal) {
  dark.addEventListener("change", () => redraw(), { signal });
}

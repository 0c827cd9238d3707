/** Controls of a clock: play, speed, slider, from impact to impact. */

import { button } from "../interface/button.js";
import { element, fill } from "../interface/element.js";
import { short, withUnit } from "../interface/numbers.js";

const SPEEDS = [1, 0.3, 0.1, 0.03, 0.01, 0.003, 0.001];
const STEPS = 4000; // of the slider

/** Returns the controls of a clock; `impacts()`, if given, the onsets of contacts in s, sorted. */
export function player(clock, impacts = null) {
  const playing = button("", () => toggle(clock), { class: "main" });
  const slider = element("input", {
    type: "range", min: 0, max: STEPS, step: 1, "aria-label": "Time",
    oninput: () => {
      const share = slider.value / STEPS; // a clock that stops shows its own time here
      clock.stop();
      clock.seek(clock.first + share * (clock.last - clock.first));
    },
  });
  const speed = element(
    "select",
    { "aria-label": "Speed", onchange: () => (clock.speed = Number(speed.value)) },
    [10, ...SPEEDS].map((value) => element("option", { value },
      value === 1 ? "real time" : value > 1 ? `${value} × faster` : `1/${Math.round(1 / value)}`)),
  );
  const nearest = [10, ...SPEEDS].reduce((best, one) =>
    Math.abs(Math.log(one / clock.speed)) < Math.abs(Math.log(best / clock.speed)) ? one : best);
  clock.speed = nearest;
  speed.value = String(nearest);
  const readout = element("output", { "aria-live": "off" });
  const jump = (sign) => () => {
    clock.stop();
    const onsets = impacts();
    const gap = 1e-9 * (clock.last - clock.first);
    const next = sign > 0
      ? onsets.find((onset) => onset > clock.time + gap)
      : onsets.findLast((onset) => onset < clock.time - gap);
    if (next !== undefined) clock.seek(next);
  };
  const jumps = impacts ? [
    button("◂ Impact", jump(-1), { title: "To the impact before" }),
    button("Impact ▸", jump(1), { title: "To the next impact" }),
  ] : [];
  const made = element(
    "div",
    { class: "player" },
    slider,
    element(
      "div",
      { class: "buttons" },
      playing,
      jumps,
      element("label", { class: "buttons small" }, "Speed ", speed),
      readout,
    ),
  );
  let shown = "";
  const refresh = (time) => {
    const state = clock.playing ? "❚❚ Pause" : "▶ Play";
    if (state !== shown) fill(playing, (shown = state));
    const share = (time - clock.first) / (clock.last - clock.first || 1);
    slider.value = String(Math.round(share * STEPS));
    const text = `t = ${withUnit(time, "s", 5)}`;
    if (readout.textContent !== text) readout.textContent = text;
    for (const one of jumps) one.disabled = !impacts().length;
    slider.setAttribute("aria-valuetext", `${short(time, 4)} seconds`);
  };
  clock.listen(refresh);
  refresh(clock.time);
  return made;
}

/** Returns a speed at which a span of simulated time takes some seconds to watch. */
export function watchable(span, seconds = 6) {
  return Math.min(1, span / seconds);
}

function toggle(clock) {
  if (clock.playing) clock.stop();
  else clock.play();
}

/** The start: mechanisms as cards, and one of them moving. */

import { workButton } from "../interface/button.js";
import { element, fill } from "../interface/element.js";
import { address, go } from "../interface/route.js";
import { trouble } from "../interface/trouble.js";
import { onNewColours } from "../mechanism/palette.js";
import { withParameters } from "../mechanism/parameters.js";
import { Sketch, calm } from "../mechanism/sketch.js";
import { firstJob } from "../interface/kinds_of_job.js";
import { get, post } from "../requests/service.js";

export async function show(room, { signal }) {
  const { scenes } = await get("/v1/scenes", {}, signal);
  const documents = await Promise.all(scenes.map(({ link }) => get(link, {}, signal)));
  const favourite = documents.find(({ reported }) => reported?.length) ?? documents[0];
  const said = element("div", { role: "status" });
  const canvas = element("canvas", {
    role: "img",
    "aria-label": `${favourite.name}, moved by its drivers`,
  });
  fill(
    room,
    element(
      "section",
      { class: "hero panel" },
      canvas,
      element(
        "div",
        {},
        element("h1", {}, "Mechanisms whose joints have play"),
        element("p", { class: "lead" }, "Real joints have clearance: journals rattle in their"
          + " bearings, strike, slide and stick. Choose a mechanism, set its clearances and"
          + " friction, and watch what it does, down to single impacts."),
        element("div", { class: "buttons" },
          runButton(favourite, said, "main", `Run the ${favourite.name.replaceAll("-", " ")}`),
          element("a", { class: "button", href: address(["new", favourite.name]) },
            "Set its parameters"),
          element("a", { class: "button", href: "#/editor" }, "Build your own")),
        said,
      ),
    ),
    element("ul", { class: "cards" }, documents.map((document) => card(document, signal, said))),
    element("section", { class: "panel" },
      element("h2", {}, "Published and computed"),
      element("p", {}, "The press was measured and simulated by others before: every number and"
        + " figure that they printed stands beside what is computed here."),
      element("a", { class: "button", href: "/report" }, "Read the report")),
  );
  const sketch = new Sketch(canvas, { margin: 36 }, signal);
  sketch.show(withParameters(favourite));
  onNewColours(() => sketch.draw(), signal);
  addEventListener("resize", () => sketch.draw(), { signal });
  if (!calm()) sketch.play();
}

function card(document, signal, said) {
  const canvas = element("canvas", {
    role: "img",
    "aria-label": `Drawing of ${document.name} in its starting position`,
  });
  let sketch = null;
  const made = element(
    "li",
    { class: "card panel" },
    canvas,
    element(
      "div",
      { class: "words" },
      element("h2", {}, element("a", { href: address(["new", document.name]) },
        document.name.replaceAll("-", " "))),
      element("p", {}, document.description),
      element("div", { class: "buttons" }, runButton(document, said)),
    ),
  );
  const begin = () => !calm() && sketch?.play();
  for (const entered of ["pointerenter", "focusin"]) made.addEventListener(entered, begin);
  for (const left of ["pointerleave", "focusout"]) {
    made.addEventListener(left, () => sketch?.stop());
  }
  const seen = new IntersectionObserver(([{ isIntersecting }]) => {
    if (!isIntersecting || sketch) return;
    sketch = new Sketch(canvas, { margin: 26 }, signal);
    sketch.show(withParameters(document));
  });
  seen.observe(canvas);
  signal.addEventListener("abort", () => seen.disconnect());
  onNewColours(() => sketch?.draw(), signal);
  addEventListener("resize", () => sketch?.draw(), { signal });
  return made;
}

function runButton(document, said, look = "", text = "Run") {
  const needs = Object.entries(document.parameters ?? {}).filter(([, { required }]) => required);
  if (needs.length) {
    return element("a", { class: "button", href: address(["new", document.name]) },
      "Set what it needs", element("span", { class: "hidden-text" }, ` (${document.name})`));
  }
  const run = async () => {
    const job = await post("/v1/jobs", await firstJob(document));
    go(["job", job.id]);
  };
  const tell = (error) => {
    fill(said, error && trouble(error));
    if (error) said.scrollIntoView({ block: "nearest" });
  };
  const what = text === "Run" && element("span", { class: "hidden-text" }, ` ${document.name}`);
  return workButton([text, what].filter(Boolean), run, tell, { class: look });
}

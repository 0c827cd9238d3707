/** What a job will cost, asked of the service before anything is queued. */

import { element, fill } from "./element.js";
import { bytes, short, span } from "./numbers.js";
import { patiently, untilAnswered } from "../requests/patiently.js";
import { Unreachable, isBusy, pause, post } from "../requests/service.js";

const QUIET = 600; // ms without a change before it is asked

export class Estimate {
  /**
   * @param document returns the job's document; throws while it is wrong
   * @param onWrong called with the errors that the service found, none if it is fine
   */
  constructor(document, signal, onWrong = () => {}) {
    Object.assign(this, { document, signal, onWrong, asking: new AbortController() });
    this.element = element("p", { class: "notice", role: "status" }, "Estimating the cost …");
    signal.addEventListener("abort", () => this.asking.abort());
  }

  later() {
    this.refresh(QUIET);
  }

  /** Says why there is none. */
  none(reason) {
    this.asking.abort();
    this.say(reason);
  }

  say(reason) {
    fill(this.element, "No estimate: ", reason);
  }

  async refresh(wait = 0) {
    this.asking.abort();
    this.asking = new AbortController();
    const { signal } = this.asking;
    try {
      await pause(wait, signal);
      const job = this.document();
      fill(this.element, "Estimating the cost …"); // what is said is of another job
      const slow = setTimeout(() => !signal.aborted && fill(this.element,
        "Estimating the cost … (equations are compiled the first time they are met)"), 1500);
      signal.addEventListener("abort", () => clearTimeout(slow));
      const ask = () => patiently(() => post("/v1/estimates", job, signal), signal, isBusy)
        .catch((error) => {
          clearTimeout(slow);
          if (error instanceof Unreachable) this.say("it comes when the service answers again.");
          throw error;
        });
      const found = await untilAnswered(ask, signal, { away: true }).finally(() => clearTimeout(slow));
      fill(this.element, words(found));
      this.onWrong([]);
    } catch (error) {
      if (error.name === "AbortError") return;
      this.none(error.message);
      if (error.errors?.length) this.onWrong(error.errors);
    }
  }
}

function words(found) {
  if (found.cached) return "An identical job is there already: it costs nothing.";
  const blocks = found.blocks === 1 ? "1 block" : `${found.blocks} blocks`;
  const points = found.points > 1 ? ` for ${found.points} points in ${blocks}` : "";
  const compiling = found.compilation > 0.05
    ? " Its equations are being compiled for the first time."
    : "";
  const devices = found.device_seconds === null ? ""
    : ` Or ${span(found.device_seconds)} of the workers' graphics processors.`;
  const failing = found.failure ? ` It will end early: ${found.failure}` : "";
  return [
    found.at_most ? "At most " : "About ", element("strong", {}, span(found.seconds)), ` of one core${points}, `,
    element("strong", {}, bytes(found.bytes)), ` of results, ${short(found.steps, 3)} steps.`,
    devices, compiling, failing,
  ];
}

/** What is shown where a view cannot be: the reason, and what to do. */

import { element } from "./element.js";
import { Problem, Unreachable } from "../requests/service.js";

/** Returns a box that says what is wrong and what helps. */
export function trouble(error, here = { view: "", parts: [] }) {
  const [title, help] = words(error, here);
  return element(
    "section",
    { class: "trouble", role: "alert" },
    element("h1", {}, title),
    element("p", {}, error.message),
    fields(error),
    help,
  );
}

/** Returns the list of wrong fields of a problem, or null. */
export function fields(error) {
  const errors = (error.errors ?? []).filter((one) => one.detail !== error.message);
  if (!errors.length) return null;
  const lines = errors.map(({ pointer, parameter, detail }) =>
    element("li", {}, element("code", {}, pointer ?? parameter ?? ""), " ", detail),
  );
  return element("ul", {}, lines);
}

function words(error, here) {
  const jobs = element("p", {}, element("a", { href: "#/jobs" }, "All jobs"), " · ",
    element("a", { href: "#/" }, "Mechanisms"));
  if (error instanceof Unreachable) return ["The service is away", null];
  if (error.status === 401) return ["This service asks for a key", null];
  if (!(error instanceof Problem)) return ["This cannot be shown", jobs];
  if (error.type === "/problems/expired-job") {
    const help = "Its results were removed. Its numbers can be computed again, bit for bit, from"
      + " its document, if you kept that.";
    return ["This job is gone", [element("p", {}, help), jobs]];
  }
  if (error.status === 404 && here.view === "job") {
    const help = "An id has 26 letters and digits. It may belong to another service, or to another"
      + " data folder of this one.";
    return ["There is no such job", [element("p", {}, help), jobs]];
  }
  return [error.title, jobs];
}

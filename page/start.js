/** The page begins here: the address chooses a view, and the view fills the content. */

import { element, fill } from "./interface/element.js";
import { keyForm } from "./interface/key_form.js";
import { address, route } from "./interface/route.js";
import { trouble } from "./interface/trouble.js";
import {
  Unreachable, get, isBusy, onKeyWanted, onReachable, pause, report,
} from "./requests/service.js";

const VIEWS = {
  start: ["Mechanisms", () => import("./views/start.js")],
  new: ["New job", () => import("./views/new_job.js")],
  jobs: ["Jobs", () => import("./views/jobs.js")],
  job: ["Job", () => import("./views/job.js")],
  compare: ["Compared jobs", () => import("./views/compare.js")],
  batches: ["Batches", () => import("./views/batches.js")],
  batch: ["Batch", () => import("./views/batch.js")],
  workers: ["Workers", () => import("./views/workers.js")],
  editor: ["Your own mechanism", () => import("./views/editor.js")],
};
const COME_BACK = 5000; // ms after which a view that a busy service did not fill is tried again
const UNFETCHED = /dynamically imported module|Importing a module script failed/;
const ONE_OF = { jobs: "job", batches: "batch" }; // as the addresses of the API are
const BELONGS = { new: "start", job: "jobs", compare: "jobs", batch: "jobs", batches: "jobs" };

const content = document.getElementById("content");
const connection = document.getElementById("connection");
const asking = document.getElementById("asking");
let leaving = new AbortController();
let away = false;

async function show() {
  leaving.abort();
  leaving = new AbortController();
  const { signal } = leaving;
  const here = route();
  fill(asking);
  if (Object.hasOwn(ONE_OF, here.view) && here.parts[0]) {
    location.replace(address([ONE_OF[here.view], ...here.parts], Object.fromEntries(here.query)));
    return;
  }
  const [title, load] = Object.hasOwn(VIEWS, here.view) ? VIEWS[here.view] : [];
  mark(Object.hasOwn(BELONGS, here.view) ? BELONGS[here.view] : here.view);
  document.title = title ? `${title} · jointplay` : "jointplay";
  try {
    if (!load) throw new Error(`There is no view “${here.view}”. Choose one above.`);
    const { show: fillIn } = await load();
    if (signal.aborted) return;
    const room = element("div", { class: `view view-${here.view}` });
    fill(content, room);
    await fillIn(room, { ...here, signal });
  } catch (error) {
    if (signal.aborted || error.name === "AbortError") return;
    const unfetched = UNFETCHED.test(error.message); // a part of the page itself did not come
    fill(content, trouble(unfetched ? new Unreachable() : error, here));
    if (unfetched) report(false);
    else if (isBusy(error)) pause(COME_BACK, signal).then(show).catch(() => {});
  }
}

function mark(view) {
  for (const link of document.querySelectorAll("nav [data-view]")) {
    if (link.dataset.view === view) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
  }
}

onReachable((reachable) => {
  if (reachable !== away) return;
  away = !reachable;
  connection.textContent = away ? "The service does not answer. Trying again …" : "";
  connection.classList.toggle("away", away);
  if (away) comeBack();
});

onKeyWanted(() => { // a view goes on with what it has: what was typed is not lost
  if (asking.hasChildNodes()) return;
  fill(asking, keyForm());
  asking.scrollIntoView({ block: "nearest" });
});

async function comeBack() {
  while (away) {
    await pause(1000);
    await get("/healthz").catch(() => {});
  }
  if (content.querySelector(".trouble")) show(); // a view that could not be filled
}

window.addEventListener("unhandledrejection", (event) => {
  const { reason } = event; // the view was left meanwhile; or the service is away, which is said above
  if (reason?.name === "AbortError" || reason instanceof Unreachable) event.preventDefault();
});
document.querySelector(".skip").addEventListener("click", (event) => {
  event.preventDefault(); // the address says which view is shown, not where on the page
  content.focus();
});
window.addEventListener("hashchange", () => {
  window.scrollTo(0, 0);
  show().then(() => content.focus({ preventScroll: true }));
});
show();

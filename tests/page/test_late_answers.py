"""Answers that come late, in another order than they were asked for, or not at all."""

import io
import json
import re
from functools import partial
from urllib.parse import parse_qs, urlsplit

import numpy as np

from tests.page.browsing import expect
from tests.worker_by_hand import SENSITIVITY

ENDED_MEANWHILE = """async () => {
  const { whenThere } = await import("/page/interface/when_there.js");
  const asked = [];
  globalThis.fetch = () => new Promise((resolve) => asked.push(resolve));
  const reply = (nth, text) => asked[nth](new Response(JSON.stringify({ text })));
  const job = { state: "running", progress: { fraction: 0.5 } };
  const { signal } = new AbortController();
  let happened;
  const context = { job, signal, onChange: (listener) => (happened = listener) };
  const room = document.createElement("div");
  const shown = whenThere(room, context, "/late", {}, ({ text }) => (room.textContent = text));
  job.state = "succeeded";
  happened(job);
  const together = asked.length;
  if (together > 1) reply(1, "all");
  reply(0, "half");
  while (asked.length < 2) await new Promise((resolve) => setTimeout(resolve));
  if (together === 1) reply(1, "all");
  await shown;
  return [together, room.textContent];
}"""
MOTION = """async () => {
  const { Motion } = await import("/page/mechanism/motion.js");
  const channels = ["arm.x", "arm.y", "arm.theta"];
  const job = { state: "running", progress: { time: 2 }, links: { history: "/late/history" },
    job: { output_step: 1, duration: 2, channels } };
  const { signal } = new AbortController();
  const scene = { bodies: { arm: {} }, joints: {}, drivers: {}, curves: [] };
  const draw = () => (globalThis.pose = motion.at(2)?.pose.arm);
  globalThis.motion = new Motion(job, scene, draw, signal);
  motion.at(2);
}"""
TILES = """async () => {
  const { Tiles } = await import("/page/charts/tiles.js");
  const wait = setTimeout;
  globalThis.setTimeout = (act) => wait(act, 0); // whatever it would wait for
  const picture = await new OffscreenCanvas(1, 1);
  picture.getContext("2d");
  const png = await picture.convertToBlob();
  globalThis.asked = {};
  globalThis.fetch = async (path) => {
    asked[path] = (asked[path] ?? 0) + 1;
    const status = path === "/tiles/0/0/0.png" ? 404 : 500;
    return asked[path] > 1 ? new Response(png) : new Response("{}", { status });
  };
  const { signal } = new AbortController();
  const draw = () => {
    const found = [0, 1, 2, 3, 4, 5, 6, 7, 8].map((x) => tiles.get(0, x, 0));
    tiles.send();
    globalThis.drawn = found.filter(Boolean).length;
  };
  const tiles = new Tiles("/tiles", {}, signal, draw);
  draw();
}"""


def test_a_job_that_ends_while_an_answer_is_on_its_way_is_shown_to_its_end(browsing, service_url):
    """Two were on their way, and the older one stayed if it came last."""
    with browsing.page(f"{service_url}/") as page:
        questions = page.evaluate(ENDED_MEANWHILE)
        assert questions == [1, "all"]


def archive(times, *, complete):
    """Return samples of an arm whose place is the time, as the service stores them."""
    columns = dict.fromkeys(("arm.x", "arm.y", "arm.theta"), np.array(times))
    file = io.BytesIO()
    np.savez(file, time=np.array(times), **columns, complete=complete)
    return file.getvalue()


def test_a_motion_goes_on_that_was_on_its_way_as_the_job_went_on(browsing, service_url):
    """It stayed as it was when it was asked for."""
    held = []
    with browsing.page(f"{service_url}/") as page:
        page.route("**/late/history*", lambda route: held.append(route))
        with page.expect_request("**/late/history*"):
            page.evaluate(MOTION)
        page.evaluate("motion.refresh()")
        with page.expect_request("**/late/history*"):
            held.pop().fulfill(body=archive([0.0, 1.0], complete=False))
        pose = page.evaluate("pose")
        assert pose == [1.0, 1.0, 1.0]  # what there is, until more comes
        held.pop().fulfill(body=archive([0.0, 1.0, 2.0], complete=True))
        page.wait_for_function("() => pose[0] === 2")
        outdated = page.evaluate("motion.refresh(); motion.chunks.get(0).outdated")
        assert outdated is False


def test_tiles_that_do_not_come_are_asked_for_again_and_keep_none_back(browsing, service_url):
    """After six that failed, no other was asked for."""
    with browsing.page(f"{service_url}/") as page:
        page.evaluate(TILES)
        page.wait_for_function("() => drawn === 8")
        asked = page.evaluate("asked")
    tiles = {f"/tiles/0/{x}/0.png": asked.get(f"/tiles/0/{x}/0.png") for x in range(9)}
    assert [*tiles.values()] == [1] + 8 * [2]  # the first is refused for good


def test_what_a_batch_refused_stays_to_be_read(browsing, http, service_url):
    """The next look at the batch wiped it away; a double click did a thing twice."""
    job = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}
    batch = http.post("/v1/batches", json={"jobs": [job]}).raise_for_status().json()["id"]
    held = []
    with browsing.page(f"{service_url}/#/batch/{batch}", expected=("409",)) as page:
        page.route("**/cancel", lambda route: held.append(route))
        cancel = page.get_by_role("button", name="Cancel all")
        with page.expect_request("**/cancel"):
            cancel.dblclick()
        looks = re.compile(f"/v1/batches/{batch}/jobs")
        page.wait_for_event("response", lambda one: looks.search(one.url))
        assert len(held) == 1
        held.pop().fulfill(status=409, json={"detail": "Not now."})
        page.get_by_role("alert").get_by_text("Not now.").wait_for()
        for _ in range(2):
            page.wait_for_event("response", lambda one: looks.search(one.url))
        expect(page.get_by_role("alert")).to_have_text("Not now.")


def test_the_output_that_was_chosen_last_is_shown(browsing, worker, service_url):
    """That of which the answer came last was."""
    job = worker.finished_study(**SENSITIVITY, failing=())
    first, second = (f"displacement.{one}" for one in ("mean", "minimum"))
    held = []
    with browsing.page(f"{service_url}/healthz") as page:
        svg = "<svg xmlns='http://www.w3.org/2000/svg' width='1' height='1'/>"
        drawn = {"body": svg, "content_type": "image/svg+xml"}
        page.route("**/figures/*", lambda route: route.fulfill(**drawn))
        page.route(f"**/sensitivity?output={first}", lambda route: held.append(route))
        page.goto(f"{service_url}/#/job/{job}")
        output = page.get_by_label("Output", exact=True)
        with page.expect_request(f"**/sensitivity?output={first}"):
            output.select_option(first)
        asked = []
        page.on("request", lambda one: asked.append(one.url))
        output.select_option(second)
        page.evaluate("async () => (await fetch('/healthz')).ok")
        assert not [one for one in asked if second in one]
        with page.expect_request(f"**/sensitivity?output={second}"):  # no sooner
            held.pop().continue_()
        page.get_by_role("img", name=f"What {second} owes to each parameter").wait_for()
        expect(output).to_have_value(second)


INSTANTS = """async ([names, count]) => {
  const { instants } = await import("/page/plots/instants.js");
  const job = { links: { history: "/long/history" }, job: { output_step: 5e-5 } };
  const { signal } = new AbortController();
  const { columns } = await instants(job, names, [0.5, 1.5], count, signal);
  const gaps = columns.x.slice(1).map((one, i) => one - columns.x[i]).sort();
  return [columns.x.length, gaps[0], gaps.at(-1), columns.x[0], columns.x.at(-1)];
}"""


NAMES = ["x", *(f"of {n}" for n in range(98))]  # of which an answer carries 9900 rows


def long_history(route, *, basis):
    """Answer as the service does, both ends of a window included: x is the time, others are not."""
    query = {name: one[0] for name, one in parse_qs(urlsplit(route.request.url).query).items()}
    start, stop = float(query["start"]), float(query["stop"])
    if "points" in query:
        return route.fulfill(body=json.dumps({"exact": True, "resolution": {"basis": basis}}))
    if "step" in query:
        step = float(query["step"])
        times = start + step * np.arange(int((stop - start) / step * (1.0 + 1e-12)) + 1)
    else:
        times = np.arange(np.ceil(start / 5e-5 - 1e-6), np.floor(stop / 5e-5 + 1e-6) + 1) * 5e-5
    assert (1 + len(NAMES)) * len(times) <= 1_000_000
    file = io.BytesIO()
    np.savez(file, time=times, **dict.fromkeys(NAMES, np.empty(0)) | {"x": times}, complete=True)
    return route.fulfill(body=file.getvalue())


def test_many_instants_have_none_twice(browsing, service_url):
    """Those at the edges of answers were there twice."""
    with browsing.page(f"{service_url}/") as page:
        for basis, step in (("steps", 1.0 / 19_999), ("intervals", 5e-5)):
            page.route("**/long/history*", partial(long_history, basis=basis))
            count, least, most, first, last = page.evaluate(INSTANTS, [NAMES, 20_000])
            page.unroute("**/long/history*")
            assert count == 20_000
            assert abs(least / step - 1.0) < 1e-6
            assert abs(most / step - 1.0) < 1e-6
            assert abs(last - 1.5) < 1e-9
            assert abs(first - (1.5 - 19_999 * step)) < 1e-9


WAITED = """async () => {
  const { pause } = await import("/page/requests/service.js");
  const left = new AbortController();
  left.abort();
  return pause(0, left.signal).catch(({ name }) => name);
}"""
CUT = """async () => {
  const { get, getBytes } = await import("/page/requests/service.js");
  const cut = () => new ReadableStream({ pull: (some) => some.error(new TypeError("cut off")) });
  globalThis.fetch = async () => new Response(cut());
  const of = (asked) => asked.catch((error) => error.constructor.name);
  return Promise.all([of(get("/v1/jobs")), of(getBytes("/v1/jobs", "text/csv"))]);
}"""


def test_faults_have_the_names_that_the_page_knows(browsing, service_url):
    with browsing.page(f"{service_url}/") as page:
        page.get_by_role("heading", level=1).wait_for()
        waited = page.evaluate(WAITED)
        cut = page.evaluate(CUT)
    assert waited == "AbortError"
    assert cut == ["Unreachable", "Unreachable"]


def test_a_motion_goes_on_after_an_answer_that_did_not_come(browsing, service_url):
    """It stood still for ever."""
    asked = []

    def answer(route):
        asked.append(route.request.url)
        if len(asked) == 1:
            route.abort()
        else:
            route.fulfill(body=archive([0.0, 1.0, 2.0], complete=True))

    with browsing.page(f"{service_url}/", expected=("ERR_FAILED",)) as page:
        page.route("**/late/history*", answer)
        page.evaluate(MOTION)
        page.wait_for_function("() => globalThis.pose?.[0] === 2")
    assert len(asked) == 2


HISTORY = """async () => {
  const { HistoryPlots } = await import("/page/plots/history_plots.js");
  const { Clock } = await import("/page/mechanism/clock.js");
  const others = fetch;
  Object.assign(globalThis, { asked: [], told: 0, left: new AbortController() });
  const held = ({ signal }) => new Promise((resolve, reject) => {
    const one = { resolve, aborted: false };
    asked.push(one);
    signal.addEventListener("abort", () => {
      one.aborted = true;
      reject(new DOMException("", "AbortError"));
    });
  });
  globalThis.fetch = (path, options) =>
    path.startsWith("/late") ? held(options) : others(path, options);
  const time = { values: [0, 1], unit: "s" };
  const channels = { a: { values: [0, 1], unit: "m", long_name: "" } };
  globalThis.reply = (nth, note, status) =>
    asked[nth].resolve(new Response(JSON.stringify({ time, channels, note }), { status }));
  const job = { job: { channels: ["a"], output_step: 1 }, links: { history: "/late/history" } };
  globalThis.plots = new HistoryPlots([job], new Clock(0, 2), left.signal, () => (told += 1));
  document.querySelector("main").replaceChildren(plots.element);
  plots.show(["a"]);
}"""


def test_a_history_comes_while_its_job_goes_on(browsing, service_url):
    """Each word of progress gave up what was on its way; and a refusal was the last word."""
    with browsing.page(f"{service_url}/") as page:
        page.get_by_role("heading", level=1).wait_for()
        page.evaluate(HISTORY)
        page.evaluate("() => plots.extend(4)")
        page.wait_for_function("() => told === 1")
        given_up = page.evaluate("() => asked.map(({ aborted }) => aborted)")
        assert given_up == [False]
        page.evaluate("() => reply(0, 'Peaks of samples.', 200)")
        expect(page.get_by_text("Peaks of samples.")).to_be_visible()
        page.wait_for_function("() => asked.length === 2")  # what has been computed meanwhile
        page.evaluate("() => reply(1, '', 500)")
        expect(page.locator(".uplot")).to_have_count(0)
        page.wait_for_function("() => asked.length === 3")
        page.evaluate("() => reply(2, '', 200)")
        expect(page.locator(".uplot")).to_have_count(1)
        expect(page.get_by_text("Peaks of samples.")).to_have_count(0)
        page.evaluate("() => plots.setWindow([0, 1])")
        page.wait_for_function("() => asked.length === 4")
        page.evaluate("() => plots.setWindow([1, 2])")  # of another window, it is given up
        page.wait_for_function("() => asked.length === 5 && asked[3].aborted")
        page.evaluate("() => left.abort()")
        drawn = page.evaluate("() => plots.plots.size")
        assert drawn == 0


FRAMES = """async () => {
  const { Clock } = await import("/page/mechanism/clock.js");
  const due = [];
  globalThis.requestAnimationFrame = (step) => due.push(step);
  const clock = new Clock(0, 10);
  for (let n = 0; n < 3; n++) {
    clock.play();
    clock.stop();
  }
  clock.play();
  const frames = [];
  for (let now = 0; now < 300; now += 100) {
    const steps = due.splice(0);
    frames.push(steps.length);
    for (const step of steps) step(now);
  }
  return [frames, clock.time];
}"""


def test_a_clock_that_is_stopped_and_started_goes_on_once(browsing, service_url):
    """It went on twice, three times … as fast."""
    with browsing.page(f"{service_url}/") as page:
        frames, time = page.evaluate(FRAMES)
    assert frames[1:] == [1, 1]
    assert abs(time - 0.2) < 1e-12


FIGURES = """async () => {
  const { show } = await import("/page/views/job/figures.js");
  const others = fetch;
  globalThis.drawn = 0;
  globalThis.fetch = async (path, options) => {
    if (!path.startsWith("/late")) return others(path, options);
    if (path.endsWith(".svg")) {
      drawn += 1;
      const circle = `<svg xmlns="http://www.w3.org/2000/svg" width="${10 * drawn}" height="10"/>`;
      return new Response(new Blob([circle], { type: "image/svg+xml" }));
    }
    const svg = "/late/orbit.svg";
    const figure = { name: "orbit", title: "An orbit", png: svg, svg };
    return new Response(JSON.stringify({ figures: [figure] }));
  };
  globalThis.job = { state: "running", progress: { fraction: 0.5 }, links: { figures: "/late" } };
  const room = document.createElement("div");
  document.querySelector("main").replaceChildren(room);
  const { signal } = new AbortController();
  show(room, { job, signal, onChange: (listener) => (globalThis.happened = listener) });
}"""


def test_figures_of_a_job_that_runs_are_drawn_anew_at_its_end(browsing, service_url):
    """Those that were drawn first stayed."""
    with browsing.page(f"{service_url}/") as page:
        page.get_by_role("heading", level=1).wait_for()
        page.evaluate(FIGURES)
        page.wait_for_function("() => document.querySelector('figure img')?.naturalWidth === 10")
        page.evaluate("() => { job.state = 'succeeded'; happened(job); }")
        page.wait_for_function("() => document.querySelector('figure img')?.naturalWidth === 20")


PANNED = """async () => {
  const { Panning } = await import("/page/plots/panning.js");
  const over = document.createElement("div");
  document.querySelector("main").replaceChildren(over);
  const moved = [];
  new Panning({ over }, { move: (share) => moved.push(share) });
  const send = (name, clientX) => over.dispatchEvent(
    new PointerEvent(name, { clientX, shiftKey: true, bubbles: true }));
  send("pointerdown", 0);
  send("pointermove", 10);
  send("pointercancel", 10);
  send("pointermove", 20);
  return moved.length;
}"""


def test_a_history_that_a_browser_scrolls_is_let_go(browsing, service_url):
    """It went on with the pointer for ever."""
    with browsing.page(f"{service_url}/") as page:
        page.get_by_role("heading", level=1).wait_for()
        moved = page.evaluate(PANNED)
    assert moved == 1

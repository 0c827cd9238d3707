"""Jobs that are compared say in what they differ, with units."""

import copy
import re
from urllib.parse import parse_qs, urlsplit

from jointplay.solver.scene import presets
from jointplay.storage.catalogue.records import BlockEnd, BlockState
from tests.page.browsing import barriers, expect
from tests.page.test_watching import MOVED


def own(clearance):
    """Return the slider-crank as a mechanism of one's own, with another clearance."""
    document = copy.deepcopy(presets.document("slider-crank"))
    document["name"] = "mine"
    document["parameters"]["clearance"]["default"] = clearance
    return document


def test_runs_of_ones_own_mechanism_are_told_apart(browsing, service_url, worker):
    tolerances = {1e-4: 1e-6, 2e-4: 1e-7}
    jobs = [
        worker.finished(scene=own(clearance), duration=1.0, tolerance=tolerance)
        for clearance, tolerance in tolerances.items()
    ]
    with browsing.page(f"{service_url}/#/compare?jobs={','.join(jobs)}") as page:
        entries = page.locator(".legend li")
        expect(entries.nth(0)).to_contain_text("clearance 100 µm, tolerance 1e−6")
        expect(entries.nth(1)).to_contain_text("clearance 200 µm, tolerance 1e−7")
        page.locator(".uplot").first.wait_for()
        assert barriers(page) == []


def test_presets_differ_in_their_parameters_and_others_in_none(browsing, service_url, worker):
    scenes = [
        {"preset": "slider-crank", "parameters": {"clearance": 1e-4, "speed": 100}},
        {"preset": "slider-crank", "parameters": {"clearance": 2e-4, "speed": 100}},
    ]
    jobs = [worker.finished(scene=scene, duration=1.0) for scene in scenes]
    with browsing.page(f"{service_url}/#/compare?jobs={','.join(jobs)}") as page:
        entries = page.locator(".legend li")
        expect(entries.nth(1)).to_contain_text("clearance 200 µm")
        expect(entries.nth(1)).not_to_contain_text("speed")


SOUGHT = """share => {
  const slider = document.querySelector("[aria-label=Time]");
  slider.value = share * slider.max;
  slider.dispatchEvent(new Event("input"));
}"""


def test_a_shorter_run_stays_as_it_ended(browsing, service_url, worker, catalogue):
    """After its end there was nothing, which was asked for again and again, without a pause."""
    jobs = []
    for duration in (1.0, 5.0):
        pendulum = {"scene": {"preset": "pendulum"}, "duration": duration, "output_step": 0.01}
        claim = worker.start(worker.submit(**pendulum))
        worker.store(claim)
        end = BlockEnd(BlockState.done, time=duration)
        catalogue.finish(claim.block.id, claim.block.attempt, end)
        jobs.append(claim.job.id)
    asked = []

    def note(request):
        if f"{jobs[0]}/history" in request.url:
            asked.append(parse_qs(urlsplit(request.url).query))

    with browsing.page(f"{service_url}/healthz", still=True) as page:
        page.on("request", note)
        page.goto(f"{service_url}/#/compare?jobs={','.join(jobs)}")
        page.wait_for_function(MOVED, arg=0)
        page.locator(".uplot").first.wait_for()
        with page.expect_response(re.compile(rf"{jobs[1]}/history\?.*start=2\.55")):
            page.evaluate(SOUGHT, 3.0 / 5.0)
        poses = [query for query in asked if "points" not in query]
        assert [float(query["start"][0]) for query in poses] == [0.0]


def test_a_job_that_is_gone_leaves_the_others(browsing, service_url, worker):
    """The whole view failed."""
    job, gone = worker.finished(), "0" * 26
    address = f"{service_url}/#/compare?jobs={gone},{job}"
    with browsing.page(address, expected=("404", "422")) as page:
        page.locator(".uplot").first.wait_for()
        expect(page.locator("main .swatch")).to_have_count(1)
        expect(page.get_by_text(f"The job {gone} is gone.")).to_be_visible()


NINTH = """async () => {
  const { ChannelChoice } = await import("/page/interface/channel_choice.js");
  const names = [1, 2, 3, 4, 5, 6, 7, 8, 9].map(String);
  const choice = new ChannelChoice(names, names.slice(0, 8), () => {});
  document.querySelector("main").replaceChildren(choice.element);
  const click = (n) => choice.list.querySelectorAll("input")[n].click();
  click(8);
  const refused = choice.element.querySelector("[role=status]")?.textContent;
  click(0);
  click(8);
  return [refused, choice.element.querySelector("[role=status]")?.textContent, choice.names.length];
}"""


def test_a_channel_too_many_is_refused_with_a_word(browsing, service_url):
    with browsing.page(f"{service_url}/") as page:
        refused, then, count = page.evaluate(NINTH)
    assert refused == "At most 8 channels are shown; leave one out first."
    assert (then, count) == ("", 8)

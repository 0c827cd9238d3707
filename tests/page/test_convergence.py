"""Where a motion is converged: Watch, Accuracy and figures tell the same of one certificate."""

from dataclasses import replace

import pytest

from jointplay.figures.time_axis import TimeAxis
from jointplay.storage.catalogue.records import BlockState
from jointplay.storage.packed import Packed
from jointplay.storage.results.reader import ResultReader
from tests.page.browsing import barriers_everywhere, expect
from tests.service.damage.subjects import certificate_of

SPANS = [[0.0, 0.0469], [0.62, 2.0]]
SHADED = """([left, right]) => {
  const canvas = document.querySelector(".u-wrap canvas");
  const context = canvas.getContext("2d");
  const row = Math.floor(canvas.height * 0.3);
  return [left, right].map((part) =>
    context.getImageData(Math.floor(canvas.width * part), row, 1, 1).data[3]);
}"""


@pytest.fixture(scope="module")
def job(worker):
    claim = worker.start(worker.submit(certificate=True, label="parts for a while"))
    found = certificate_of(claim)
    exponent = {
        "value": 0.1,
        "error": 0.2,
        "lowest": 0.0,
        "highest": 0.2,
        "windows": 2,
        "time": 1.0,
    }
    facts = {"horizon": SPANS[0][1], "converged": SPANS, "exponent": exponent, "forces_until": 0.01}
    certificate = replace(found, attributes={**found.attributes, **facts})
    worker.store(claim, certificate=certificate)
    worker.finish(claim, BlockState.done)
    return claim.job.id


def test_one_story_is_told_of_spans_that_are_not_converged(
    browsing, service_url, settings, job, artifacts
):
    with browsing.page(f"{service_url}/#/job/{job}/watch", expected=("Canvas2D",)) as page:
        words = "not converged, 46.9 ms to 620 ms: other tolerances take other paths"
        page.get_by_text(words).wait_for()
        page.screenshot(path=artifacts / "converged-watch.png", full_page=True)
        within, beyond = page.evaluate(SHADED, [0.32, 0.7])
        assert within > beyond, "what comes after the span is not shaded"
        page.goto(f"{service_url}/#/job/{job}/accuracy")
        page.get_by_text(
            "Trust the curve from 0 s to 46.9 ms, 620 ms to 2 s. From 46.9 ms to 620 ms other"
            " tolerances take other paths: trust the statistics there."
        ).wait_for()
        page.get_by_text("Small differences show no lasting growth").wait_for()
        expect(page.get_by_text("have grown so much")).to_have_count(0)
        expect(page.get_by_text("Small differences do not grow")).to_have_count(0)
        assert barriers_everywhere(page) == {}
        page.screenshot(path=artifacts / "converged-accuracy.png", full_page=True)
    run = ResultReader(Packed(settings.sealed_run(job, 1)))
    times = run.history([], 0, run.samples)[0]
    assert TimeAxis(run, [times]).unconverged == [(0.0469, 0.62)]

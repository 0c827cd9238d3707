"""Windows over HTTP of a run that a worker computed: what is between its samples is in them."""

import numpy as np
import pytest

from jointplay.client import Client
from jointplay.records.job import JobError
from jointplay.records.resolution import Resolution
from jointplay.service.answering import Busy, Hindered, NoAnswer, TooSlow
from jointplay.service.results import schemas
from jointplay.storage.catalogue.records import BlockState
from jointplay.storage.packed import Packed
from jointplay.storage.results.reader import ResultReader

DURATION, STEP = 0.06, 0.004
FORCE = "A.normal_force"


@pytest.fixture(scope="module")
def job(worker):
    """A press whose samples step over nearly every impact."""
    claim = worker.start(worker.submit(duration=DURATION, output_step=STEP, label="exact"))
    worker.run(claim)
    worker.finish(claim, BlockState.done)
    return claim.job.id


def ask(http, job, what="history", status=200, **query):
    answer = http.get(f"/v1/jobs/{job}/{what}", params=query)
    assert answer.status_code == status, answer.text
    return answer.json()


def test_a_list_of_figures_computes_nothing(application, http, job):
    process = application.state.windows._process
    process.close()
    listed = [one["name"] for one in ask(http, job, "figures")["figures"]]
    assert {"impact-loop", "orbit", "certificate", "energy"} - set(listed) == {"certificate"}
    assert not process.running(), "no kernel was asked for"
    for name in listed:
        assert http.get(f"/v1/jobs/{job}/figures/{name}.png").status_code == 200, name
    assert [one["name"] for one in ask(http, job, "figures")["figures"]] == listed


def test_every_peak_is_in_a_window_of_any_resolution(http, job):
    peak = ask(http, job, "peaks")["peaks"][FORCE]
    samples = ask(http, job, channels=FORCE)["channels"][FORCE]["values"]
    assert max(samples) < 0.7 * peak["maximum"]
    for points in (1, 7, 2000):
        shown = schemas.Overview.model_validate(ask(http, job, channels=FORCE, points=points))
        assert shown.exact
        assert shown.note == ""
        assert shown.resolution == schemas.Resolution(basis="steps")
        assert len(shown.bins.first) == points
        highest = shown.extremes[FORCE].maximum
        assert max(highest) == pytest.approx(peak["maximum"], rel=1e-6)
        place = int(np.argmax(highest))
        assert shown.bins.first[place] <= peak["maximum_time"] <= shown.bins.last[place]


def test_a_window_behind_the_run_has_no_spans(http, service_url, job):
    behind = {"channels": FORCE, "points": 3, "start": 1.0, "stop": 2.0}
    shown = schemas.Overview.model_validate(ask(http, job, **behind))
    assert (shown.samples, shown.bins.first, shown.bins.last) == (0, [], [])
    assert (shown.extremes[FORCE].minimum, shown.extremes[FORCE].maximum) == ([], [])
    with Client(service_url) as client:
        window = client.job(job).window(FORCE, 1.0, 2.0, points=3)
    assert window.time.size == window[FORCE].size == 0


def test_values_at_any_instants_are_those_that_samples_have(http, job):
    samples = ask(http, job)
    assert samples["resolution"] == {"basis": "samples", "spacing": STEP, "since": None}
    again = ask(http, job, step=STEP)
    assert again["time"]["values"] == pytest.approx(samples["time"]["values"], abs=1e-15)
    for name, one in samples["channels"].items():
        close = np.array(again["channels"][name]["values"])
        scale = np.abs(close).max() + 1e-9
        assert np.allclose(close, one["values"], rtol=0.0, atol=1e-9 * scale)


@pytest.mark.parametrize("step", [1e-8, 1e-300, 5e-324])
def test_a_step_too_fine_for_an_answer_is_refused_with_one_that_is_not(http, job, step):
    problem = ask(http, job, status=422, channels=FORCE, step=step)
    assert problem["type"] == "/problems/response-too-large"
    assert "inf" not in problem["detail"]
    (error,) = problem["errors"]
    assert error["parameter"] == "step"
    advised = float(error["detail"].split()[-2])
    assert advised == pytest.approx(DURATION / 500_000, rel=0.02)
    shown = ask(http, job, channels=FORCE, step=advised, stop=DURATION)
    assert 0.98 * 500_000 < len(shown["time"]["values"]) <= 500_000


def test_one_impact_shows_its_loop_of_force_over_penetration(http, job):
    (impact, *_) = [
        one
        for one in ask(http, job, "impacts")["impacts"]
        if one["peak_force"] > 200.0 and one["release"]
    ]
    names = ("A.penetration", FORCE)
    window = {"start": impact["onset"], "stop": impact["release"]}
    shown = ask(http, job, channels=",".join(names), step=1e-6, **window)["channels"]
    depth, force = (np.array(shown[name]["values"]) for name in names)
    assert len(force) > 50
    assert force.max() == pytest.approx(impact["peak_force"], rel=1e-4)
    assert depth[0] == pytest.approx(0.0, abs=1e-9)
    into = np.trapezoid(force, depth)  # the loop's area is what the impact lost
    assert into > 0.0


def test_a_spectrum_has_the_variance_of_its_window_and_reaches_beyond_the_samples(http, job):
    window = {"start": 0.02, "stop": 0.021}  # whose frequencies are few, so that all are shown
    found = ask(http, job, "spectrum", channels="slider7.x", **window)["spectra"]["slider7.x"]
    assert found["unit"] == "m²/Hz"
    assert found["band_limit"] == pytest.approx(512 / 1e-3)
    assert found["frequency"][-1] == pytest.approx(found["band_limit"], rel=0.03)
    shown = ask(http, job, channels="slider7.x", step=1e-3 / 1024, **window)["channels"]
    values = np.array(shown["slider7.x"]["values"])
    weights = 0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(len(values)) / len(values))
    windowed = weights * (values - values.mean())
    area = sum(found["density"]) * found["frequency"][0]
    left_out = np.abs(windowed.sum()) ** 2 / len(values)  # of the frequency zero
    assert area == pytest.approx(((windowed**2).sum() - left_out) / (weights**2).sum(), rel=1e-6)
    declared = {"displacement", "velocity", "acceleration"}
    assert ask(http, job, "spectrum")["spectra"].keys() == declared
    assert "fewer than 32" in ask(http, job, "spectrum", start=0.02, stop=0.02)["note"]
    ask(http, job, "spectrum", 422, channels="*")


def test_peaks_of_a_window_are_reached_in_it(http, job):
    window = {"start": 0.02, "stop": 0.03}
    found = ask(http, job, "peaks", **window)["peaks"]
    for name, one in found.items():
        assert window["start"] <= one["minimum_time"] <= window["stop"]
        assert window["start"] <= one["maximum_time"] <= window["stop"]
        shown = ask(http, job, channels=name, points=1, **window) if name == FORCE else None
        if shown:
            assert shown["extremes"][name]["maximum"] == [one["maximum"]]


def test_what_cannot_be_computed_is_refused_or_said(http, job, worker):
    assert "not both" in ask(http, job, points=3, step=1e-3, status=422)["detail"]
    assert "most" in ask(http, job, step=1e-9, status=422)["detail"]
    after = ask(http, job, step=1e-3, start=2 * DURATION, status=422)
    assert after["errors"][0]["parameter"] == "start"
    for what, more in (("history", {"step": 1e-3}), ("peaks", {})):
        for end, query in (("start", {"start": 2 * DURATION}), ("stop", {"stop": -1.0})):
            refused = ask(http, job, what, 422, **query, **more)
            assert [one["parameter"] for one in refused["errors"]] == [end]
    assert ask(http, job, "peaks", start=DURATION)["peaks"][FORCE]["maximum_time"] == DURATION
    by_hand = worker.finished(label="without steps")
    assert "keeps no steps" in ask(http, by_hand, step=1e-3, status=422)["detail"]
    assert "keeps no steps" in ask(http, by_hand, "peaks", start=0.5, status=422)["detail"]
    shown = ask(http, by_hand, points=3)
    assert not shown["exact"]
    assert shown["resolution"]["basis"] == "samples"
    assert "keeps no steps" in shown["note"]


@pytest.mark.parametrize("reason", [Busy, Hindered, NoAnswer, TooSlow])
@pytest.mark.parametrize("media_type", ["application/json", "text/csv"])
def test_numbers_do_not_depend_on_the_load(application, http, job, monkeypatch, reason, media_type):
    """An overview was of samples alone, with status 200, whenever the service was busy."""

    def answer(question):
        raise reason

    query = {"channels": FORCE, "points": 7}
    address, accepted = f"/v1/jobs/{job}/history", {"Accept": media_type}
    whole = http.get(address, params=query, headers=accepted).raise_for_status()
    with monkeypatch.context() as patch:
        patch.setattr(application.state.windows._process, "answer", answer)
        found = http.get(address, params=query, headers=accepted)
    if reason is TooSlow and media_type == "application/json":
        assert found.status_code == 200
        assert not found.json()["exact"]
        assert "too long" in found.json()["note"]
    else:
        assert found.status_code == 503
        assert 0 < int(found.headers["Retry-After"]) <= 30
        assert found.json()["type"] == "/problems/unavailable"
    assert http.get(address, params=query, headers=accepted).content == whole.content


def test_a_running_job_has_windows_and_peaks_of_what_is_committed(http, worker):
    settle = 0.02  # s, behind the highest impact
    fields = {"duration": 0.5, "output_step": 0.01, "label": "running", "settle": settle}
    claim = worker.start(worker.submit(**fields))
    worker.run(claim, reports=2)
    reached = ask(http, claim.job.id)["time"]["values"][-1]
    assert settle < reached <= 0.5
    shown = ask(http, claim.job.id, channels=FORCE, points=500)
    assert shown["exact"]
    assert shown["bins"]["last"][-1] == pytest.approx(reached)
    whole = ask(http, claim.job.id, "peaks", start=0)["peaks"][FORCE]["maximum"]
    assert max(shown["extremes"][FORCE]["maximum"]) == pytest.approx(whole, rel=1e-5)
    settled = ask(http, claim.job.id, "peaks")
    assert settled == ask(http, claim.job.id, "peaks", start=settle)
    assert settled["peaks"][FORCE]["maximum"] < 0.9 * whole
    error = JobError("solver", "step-size-underflow", "No step.")
    worker.finish(claim, BlockState.failed, error)


def test_the_client_reads_what_the_service_says(service_url, settings, job):
    with Client(service_url) as client:
        found = client.job(job)
        window = found.window(FORCE, points=300)
        assert window.between_samples
        assert window.resolution == Resolution("steps")
        assert not window.exact
        peak = ResultReader(Packed(settings.sealed_run(job, 1))).peaks()[FORCE]
        assert window[FORCE].max() == pytest.approx(peak.maximum, rel=1e-6)
        fine = found.window(FORCE, 0.02, 0.03, step=1e-6)
        assert fine.exact
        assert len(fine.time) == 10_001
        assert found.results.peaks(0.02, 0.03)[FORCE].maximum >= fine[FORCE].max() * (1 - 1e-9)


def test_peaks_leave_out_what_the_job_leaves_out_as_settling(http, job, worker):
    claim = worker.start(worker.submit(duration=DURATION, output_step=STEP, settle=0.05))
    worker.run(claim)
    worker.finish(claim, BlockState.done)
    found = ask(http, claim.job.id, "peaks")["peaks"]
    expected = ask(http, job, "peaks", start=0.05)["peaks"]
    assert found.keys() == expected.keys()
    whole = ask(http, job, "peaks")["peaks"]
    assert found[FORCE]["maximum"] < 0.9 * whole[FORCE]["maximum"]
    for name, one in expected.items():
        # as extremes are sharp; below 1e-9 channels have nothing but rounding
        sharp = 1e-6 * (one["maximum"] - one["minimum"]) + 1e-9
        for part in ("minimum", "maximum"):
            assert found[name][part] == pytest.approx(one[part], abs=sharp)
    refused = http.post(
        "/v1/jobs",
        json={
            "kind": "simulate",
            "scene": {"preset": "pendulum"},
            "duration": 1.0,
            "settle": 1.0,
        },
    )
    assert refused.status_code == 422
    assert "/settle" in refused.text

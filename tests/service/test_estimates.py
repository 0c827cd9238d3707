"""Estimates of the cost of a job, against what it costs."""

import pytest

from jointplay.service.estimates import on_devices
from jointplay.service.prober import Prober
from jointplay.solver.kinds import Admission, Study, admit
from jointplay.solver.runs.dense_output.columns import most_steps, step_columns
from jointplay.solver.runs.simulate import Simulation
from jointplay.solver.runs.study.run import StudyRun
from jointplay.solver.runs.work_precision.run import WorkPrecisionRun
from jointplay.solver.scene import presets
from jointplay.storage.catalogue.at_work import Devices
from jointplay.storage.catalogue.records import Solver, WorkerDevice
from tests.presets_given import given

LONG = {
    "andrews-squeezer": 0.3,
    "bouncing-journal": 2000.0,
    "double-four-bar": 2000.0,
    "pendulum": 2000.0,
    "seven-bar-press": 100.0,
}
"""Seconds that take longer than an estimate, as 30 s of the others do; the squeezer gets faster and
faster, and takes as many steps in 3 s as others in an hour."""
STUDY = {
    "kind": "bifurcation",
    "scene": {"preset": "slider-crank"},
    "parameter": "clearance",
    "values": {"from": 1e-4, "to": 5e-4, "count": 64},
    "settle": 50,
}


def estimated(http, job):
    answer = http.post("/v1/estimates", json=job, timeout=120)
    assert answer.status_code == 200, answer.text
    return answer.json()


SAMPLED = ("bouncing-journal", "pendulum", "seven-bar-press")
"""One of contacts without a period, one of none, one of both."""


@pytest.mark.parametrize(
    "name",
    [
        name if name in SAMPLED else pytest.param(name, marks=pytest.mark.long)
        for name in presets.names()
    ],
)
def test_an_estimate_is_right_within_a_factor_of_two(http, name):
    job = {"kind": "simulate", "scene": given(name), "duration": LONG.get(name, 30.0)}
    estimate = estimated(http, job)
    admission = admit(job)
    assert isinstance(admission, Admission)
    simulation = Simulation(admission)
    for _ in simulation.slices():
        pass
    steps = simulation.summary().statistics["steps"]
    assert steps / 2 < estimate["steps"] < 2 * steps
    # half of what is not compressed at all: numbers are noisy; each file has its page of metadata
    kept = 8 * len(step_columns(admission)) * min(steps, most_steps(admission))
    stored = admission.stored_bytes + kept
    assert 0.25 * stored < estimate["bytes"] < 1.5 * stored
    assert estimate["seconds"] > 0
    assert (estimate["points"], estimate["blocks"], estimate["failure"]) == (1, 1, None)


@pytest.fixture
def device(catalogue):
    """A device of a worker: its rate and lanes are told, nothing is computed."""
    told = WorkerDevice("a card", 1e9, 64)
    catalogue.note_worker("with a card", Solver("1", "zen4"), told)
    yield
    catalogue.forget_workers(["with a card"])


@pytest.mark.usefixtures("device")
def test_an_estimate_of_a_study_is_right_within_a_factor_of_two(http):
    estimate = estimated(http, STUDY)
    study = admit(STUDY)
    assert isinstance(study, Study)
    steps = sum(
        point.statistics["steps"]
        for block in range(len(study.blocks))
        for piece in StudyRun(study, block).slices()
        for point in piece.ended
    )
    assert steps / 2 < estimate["steps"] < 2 * steps
    assert (estimate["points"], estimate["blocks"]) == (64, len(study.blocks))
    assert not estimate["exact"]
    cores = estimate["seconds"] / estimate["device_seconds"]
    assert 5.0 < cores < 5000.0  # a core makes some millions of steps a second


def test_devices_take_the_longer_the_fewer_points_fill_their_lanes():
    devices = {"a card": Devices(2, 2e6, 8), "another": Devices(1, 1e6, 4)}
    assert on_devices(3e6, 12, devices) == on_devices(3e6, 100, devices) == 1.0
    assert on_devices(3e6, 3, devices) == 4.0


def test_an_estimate_of_a_refined_map_is_the_most_that_it_may_cost(http):
    chart = {
        "kind": "chart",
        "scene": {"preset": "impact-oscillator"},
        "along": {"parameter": "speed", "values": {"from": 10.0, "to": 40.0, "count": 33}},
        "by": {"parameter": "amplitude", "values": {"from": 1e-3, "to": 2e-2, "count": 33}},
        "settle": 4,
        "record": 8,
        "indicators": ["recurrence"],
    }
    whole, refined = estimated(http, chart), estimated(http, chart | {"refine": 3})
    assert (whole["at_most"], refined["at_most"]) == (False, True)
    assert refined["points"] == whole["points"] == 33 * 33


@pytest.mark.usefixtures("device")
def test_an_estimate_of_a_short_accuracy_study_is_exact(http):
    study = {"kind": "accuracy-study", "scene": {"preset": "seven-bar-press"}, "duration": 0.003}
    estimate = estimated(http, study)
    admitted = admit(study)
    assert isinstance(admitted, Study)
    ended = [end for piece in WorkPrecisionRun(admitted, 0).slices() for end in piece.ended]
    assert estimate["steps"] == sum(end.statistics["steps"] for end in ended)
    assert (estimate["points"], estimate["blocks"]) == (admitted.points, 1)
    assert (estimate["exact"], estimate["failure"]) == (True, None)
    assert 0.0 < estimate["seconds"] < 60.0  # without compiling
    assert estimate["device_seconds"] is None  # no device computes such a study


def test_nothing_is_queued_and_a_short_job_is_known_exactly(http):
    job = {"kind": "simulate", "scene": {"preset": "seven-bar-press"}, "duration": 0.0625}
    before = http.get("/v1/jobs").json()["jobs"]
    estimate = estimated(http, job)
    assert (estimate["exact"], estimate["cached"]) == (True, False)
    assert http.get("/v1/jobs").json()["jobs"] == before
    assert estimated(http, job)["compilation"] == 0.0  # it was compiled for the first one
    http.post("/v1/jobs", json=job)
    assert estimated(http, job)["cached"]
    assert not estimated(http, job | {"cache": False})["cached"]


def test_a_wrong_job_is_refused_as_a_submission_is(http):
    answer = http.post("/v1/estimates", json={"kind": "simulate", "scene": {"preset": "pendulum"}})
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["pointer"] == "/duration"


def test_a_probe_that_ended_is_started_again():
    prober = Prober()
    job = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}
    spec = admit(job).job
    try:
        first = prober.cost_of(spec)
        (process,) = prober._process.running()
        process.kill()
        process.wait()
        assert prober.cost_of(spec)["steps"] == first["steps"]
    finally:
        prober.close()

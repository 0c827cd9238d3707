"""The bits of a run depend on its job alone: not on company, slices, interruptions or outputs."""

from collections.abc import Iterable
from itertools import cycle
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from jointplay.solver.integrators import TSITOURAS5
from jointplay.solver.kernels.emit.kernel import compile_kernel
from jointplay.solver.kernels.loop.runs import IMPACT, SAMPLES, SECTIONS, Status
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.kinds.simulate import sample_count
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.runs import budget as slice_budget
from jointplay.solver.runs.certificate.certificate import Certificate
from jointplay.solver.runs.simulate import Simulation
from tests.solver.completed_runs import CASE_3, Run, collect
from tests.solver.readable_mechanics import preset

PROBLEMS = [
    LaneProblem(
        preset(
            "seven-bar-press",
            **{
                **CASE_3,
                "clearance_A": 1e-4 * (1 + lane),
                "friction": 0.02 * (8 - lane),
                "speed": [3.0, -2.0, 5.0, 1.0, 7.0, -4.0, 3.0, 6.0][lane],
                "speed_crank4": [-3.0, 4.0, 5.0, 1.7, -7.0, 2.0, 1.0, -6.0][lane],
            },
        ),
        duration,
        tolerance,
        duration / 37.5,
        sample_count(duration, duration / 37.5),
        0,
        0.0,
    )
    for lane, (duration, tolerance) in enumerate(
        zip(
            [0.05, 0.3, 0.02, 0.2, 0.1, 0.15, 0.25, 0.08],
            [1e-6, 1e-7, 1e-9, 1e-5, 1e-8, 1e-6, 1e-6, 1e-10],
            strict=True,
        )
    )
]
RECORDS = ("highest", "lowest", "highest_time", "lowest_time")
"""Eight runs of the press that end at different times, at different tolerances and speeds."""


def bundle_of(problems: list[LaneProblem]) -> Bundle:
    scene = problems[0].scene
    return Bundle(compile_kernel(scene, spanning_tree(scene), "reduced", TSITOURAS5), problems)


def finish(bundle: Bundle, budgets: Iterable[int]) -> list[dict[str, bytes]]:
    """Advance until all lanes are done; return, per lane, the bytes of all that it gave."""
    lanes = [int(i) for i in np.flatnonzero(bundle.runs["status"] != Status.IDLE)]
    handed_out: list[dict[str, list[bytes]]] = [
        {"samples": [], "sections": [], "impacts": []} for _ in lanes
    ]
    running = True
    for budget in budgets:
        if not running:
            break
        running = bundle.advance(budget) > 0
        for lane in lanes:
            handed_out[lane]["samples"].append(bundle.rows(SAMPLES, lane).tobytes())
            handed_out[lane]["sections"].append(bundle.rows(SECTIONS, lane).tobytes())
            handed_out[lane]["impacts"].append(bundle.impacts(lane).tobytes())
    found = []
    for lane in lanes:
        assert bundle.runs["status"][lane] == Status.DONE
        kept = {name: b"".join(parts) for name, parts in handed_out[lane].items()}
        for name in ("time", "steps", "smallest_step", "y", "total", *RECORDS):
            kept[name] = bundle.lane(lane)[name].tobytes()
        for name in ("periods", "next", "rejections", "onsets"):
            kept[name] = bundle.runs[name][lane].tobytes()
        found.append(kept)
    return found


@pytest.fixture(scope="module")
def alone() -> list[dict[str, bytes]]:
    """Return each of the eight runs computed in a bundle of its own, in one call."""
    return [finish(bundle_of([problem]), [10**7])[0] for problem in PROBLEMS]


def test_the_eight_runs_are_different_and_worth_comparing(alone: list[dict[str, bytes]]) -> None:
    assert len({kept["y"] for kept in alone}) == 8
    for kept in alone:
        assert np.frombuffer(kept["onsets"], dtype=np.int64)[0] >= 3
        assert len(kept["impacts"]) >= 2 * IMPACT.itemsize
        assert len(kept["samples"]) > 38 * 8


def test_a_run_has_the_same_bits_alone_and_in_any_lane(alone: list[dict[str, bytes]]) -> None:
    assert finish(bundle_of(PROBLEMS), cycle([10**7])) == alone
    order = [5, 2, 7, 0, 3, 6, 1, 4]
    shuffled = finish(bundle_of([PROBLEMS[i] for i in order]), cycle([10**7]))
    assert shuffled == [alone[i] for i in order]


@settings(max_examples=6)
@given(st.lists(st.integers(1, 60), min_size=1, max_size=8))
def test_slicing_does_not_change_a_bit(budgets: list[int]) -> None:
    three = [PROBLEMS[0], PROBLEMS[2], PROBLEMS[7]]
    expected = [finish(bundle_of([problem]), [10**7])[0] for problem in three]
    assert finish(bundle_of(three), cycle(budgets)) == expected


# through the public interface

JOB: dict[str, Any] = {
    "kind": "simulate",
    "scene": {"preset": "seven-bar-press", "parameters": {**CASE_3, "speed": 20.0}},
    "duration": 0.7,
    "output_step": 2e-5,
    "tolerance": 1e-7,
    "channels": ["slider7.*", "A.*", "energy.*"],
    "section": {"crank_angle": 1.0},
}
"""So many samples that row buffers fill, and the run is handed out in many slices; two periods."""


def job(**changes: Any) -> Admission:
    return admit({**JOB, **changes})


def whole(admission: Admission) -> Run:
    simulation = Simulation(admission)
    return collect(admission, list(simulation.slices()), simulation)


def assert_same(one: Run, two: Run) -> None:
    assert one.time.tobytes() == two.time.tobytes()
    assert one.section_time.tobytes() == two.section_time.tobytes()
    assert one.impacts.tobytes() == two.impacts.tobytes()
    for name, values in one.samples.items():
        assert values.tobytes() == two.samples[name].tobytes(), name
        assert one.sections[name].tobytes() == two.sections[name].tobytes(), name
    assert_same_conclusion(one, two)


def assert_same_conclusion(one: Run, two: Run) -> None:
    for name in one.peaks.keys() & two.peaks.keys():
        assert one.peaks[name] == two.peaks[name], name
    assert {k: v for k, v in one.statistics.items() if k != "solver_seconds"} == {
        k: v for k, v in two.statistics.items() if k != "solver_seconds"
    }


def assert_same_certificate(one: Certificate | None, two: Certificate | None) -> None:
    assert one is not None
    assert two is not None
    assert one.facts == two.facts
    for name in ("time", "error", "until", "extremes", "edges", "share", "spread"):
        assert getattr(one, name).tobytes() == getattr(two, name).tobytes(), name


def test_two_runs_of_a_job_have_the_same_bits() -> None:
    assert_same(whole(job()), whole(job()))


@pytest.mark.parametrize(
    "formulation", ["reduced", pytest.param("lagrange", marks=pytest.mark.long)]
)
def test_a_run_restarted_from_any_checkpoint_has_the_bits_of_an_undisturbed_one(
    formulation: str,
) -> None:
    admission = job(formulation=formulation)
    undisturbed = whole(admission)
    assert undisturbed.admission.sections == len(undisturbed.section_time) == 3
    simulation = Simulation(admission)
    slices, count = [], 0
    while True:
        # a new process would do as here: it has nothing but the job and the checkpoint
        found = next(simulation.slices(), None)
        if found is None:
            break
        slices.append(found)
        count += 1
        simulation = Simulation(admission, simulation.checkpoint())
    assert count >= 5
    assert_same(collect(admission, slices, simulation), undisturbed)
    once = Simulation(admission)
    list(once.slices())
    assert_same_certificate(simulation.certificate(), once.certificate())


def test_a_checkpoint_does_not_disturb_the_run_it_is_taken_from() -> None:
    admission = job()
    simulation = Simulation(admission)
    slices = []
    for found in simulation.slices():
        slices.append(found)
        simulation.checkpoint()
        simulation.summary()
    assert_same(collect(admission, slices, simulation), whole(admission))


def test_outputs_do_not_change_the_motion() -> None:
    one = whole(job())
    coarse = whole(job(output_step=0.0123, section={"crank_angle": 0.0}))
    everything = whole(job(channels=["*"]))
    for other in (coarse, everything):
        assert other.impacts.tobytes() == one.impacts.tobytes()
        assert (
            other.last("slider7.x", "slider7.vx", "A.penetration").tobytes()
            == one.last("slider7.x", "slider7.vx", "A.penetration").tobytes()
        )
        assert_same_conclusion(one, other)


@pytest.mark.parametrize(
    "changes",
    [{}, pytest.param({"formulation": "lagrange", "duration": 0.2}, marks=pytest.mark.long)],
    ids=["reduced", "lagrange"],
)
def test_a_certificate_does_not_change_a_bit(changes: dict[str, Any]) -> None:
    assert_same(whole(job(**changes)), whole(job(**changes, certificate=False)))


def test_a_longer_run_begins_with_the_bits_of_a_shorter_one() -> None:
    short, long = whole(job(duration=0.3)), whole(job())
    before = short.time < 0.2999  # the last step of the short run is cut to end there
    count = int(before.sum())
    ended = short.impacts["release"] < 0.299
    assert long.time[:count].tobytes() == short.time[:count].tobytes()
    for name, values in short.samples.items():
        # the peak scan and the dense output of steps that end earlier are the same steps
        cut = int((short.time < 0.29).sum())
        assert long.samples[name][:cut].tobytes() == values[:cut].tobytes(), name
    assert ended.sum() > 10
    assert long.impacts[: ended.sum()].tobytes() == short.impacts[ended].tobytes()


def test_a_lane_loaded_while_others_run_gives_the_bits_of_a_run_of_its_own(
    alone: list[dict[str, bytes]],
) -> None:
    """Sweeps refill lanes: the newcomer starts in the midst of its companions' steps."""
    bundle = bundle_of([PROBLEMS[0], PROBLEMS[1]])
    bundle.advance(700)
    bundle.runs["status"][1] = Status.IDLE
    bundle.load(1, PROBLEMS[5])
    bundle.load(4, PROBLEMS[3])
    while bundle.advance(900):
        pass
    for lane, problem in ((1, 5), (4, 3), (0, 0)):
        assert bundle.lane(lane)["y"].tobytes() == alone[problem]["y"]
        for name in RECORDS:
            assert bundle.lane(lane)[name].tobytes() == alone[problem][name]
        assert bundle.lane(lane)["steps"].tobytes() == alone[problem]["steps"]
        assert bundle.runs["onsets"][lane].tobytes() == alone[problem]["onsets"]


def test_a_lane_used_before_keeps_no_marks_of_rows_that_are_not_there() -> None:
    # 13 rows of the pendulum: the last word of marks has three bytes that no scan writes
    scene = preset("pendulum")
    bundle = bundle_of([LaneProblem(scene, 0.1, 1e-6, 0.1, 2, 0, 0.0)])
    rows = bundle.kernel.rows.scanned
    assert rows % 8
    problem = LaneProblem(scene, 1.0, 1e-6, 1.0, 2, 0, 0.0)
    bundle.groups[0].work[bundle.kernel.layout.block("marked")].view(np.uint8)[:] = 0xFF
    bundle.load(0, problem)
    alone = bundle_of([problem])
    for each in (bundle, alone):
        while each.advance(1000):
            pass
    for name in RECORDS:
        found, expected = (each.lane(0)[name] for each in (bundle, alone))
        assert found.tobytes() == expected.tobytes(), name


@pytest.mark.long
def test_a_certificate_does_not_depend_on_slices(monkeypatch: pytest.MonkeyPatch) -> None:
    # over a hundred periods each window of the exponent has several rows of growth to sum
    admission = job(duration=200.0, output_step=1.0)
    found = []
    for most in (20_000, 997):
        monkeypatch.setattr(slice_budget, "LARGEST", most)
        simulation = Simulation(admission)
        assert len(list(simulation.slices())) > 10
        found.append(simulation.certificate())
    assert_same_certificate(*found)

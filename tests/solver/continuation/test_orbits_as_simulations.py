"""Orbits of a branch as simulations that start on them, unstable ones, too."""

import math

import numpy as np
import pytest

from jointplay.records.failure import InvalidInput
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem, LaneStart
from jointplay.solver.runs.certificate.companions import Companions
from tests.solver.completed_runs import run
from tests.solver.continuation.oscillator import document
from tests.solver.continuation.test_branches import SOFT, followed, names, table

FOUND = 1e-8
"""Distance of a section and its return that an orbit may have, in scales of the states."""
STATES = ["mass.x", "mass.vx"]


def orbit_at(row: int) -> tuple[float, float, list[float]]:
    """Return speed, largest multiplier and section of an orbit of the branch, rates included."""
    study, slices = followed()
    found = table(list(slices), study)
    size = math.hypot(found["multiplier_1.real"][row], found["multiplier_1.imaginary"][row])
    kinds = ("state.", "rate.", "impact_rate.")
    columns = [name for kind in kinds for name in found if name.startswith(kind)]
    return found["value"][row], size, [float(found[name][row]) for name in columns]


def unstable_row() -> int:
    study, slices = followed()
    found = table(list(slices), study)
    folds = np.flatnonzero(found["label"] == names.index("LP"))
    return int(folds[0] + (folds[1] - folds[0]) // 2)


@pytest.mark.parametrize("row", [3, unstable_row])
def test_a_simulation_stays_on_its_orbit_as_long_as_multipliers_let_it(row) -> None:  # type: ignore[no-untyped-def]
    speed, size, state = orbit_at(row() if callable(row) else row)
    periods, scene = 4, document(SOFT)
    scene["drivers"]["motor"]["speed"] = speed
    del scene["parameters"]
    duration = periods * 2.0 * math.pi / speed
    found = run(scene, duration, tolerance=1e-11, state=state, certificate=False)
    assert len(found.section_time) == periods + 1
    for name in STATES:
        passed = found.sections[name]
        # scales of the oscillator: 1 m and 20 m/s at most; errors grow by the multiplier a period
        bound = 20.0 * FOUND * max(1.0, size) ** np.arange(periods + 1)
        assert (np.abs(passed - passed[0]) <= bound).all(), name
    impacts = len(found.contacts("stop"))
    assert impacts == (0 if row == 3 else periods)


def test_a_simulation_begins_in_the_state_that_it_is_given() -> None:
    scene = document(SOFT)
    found = run(scene, 0.01, state=[-0.195, 0.25], certificate=False)
    assert found["mass.vx"][0] == 0.25
    other = run(scene, 0.01, certificate=False)
    assert found.admission.digest != other.admission.digest
    assert found["mass.x"][0] != other["mass.x"][0]


@pytest.mark.parametrize(
    ("changes", "pointer", "words"),
    [
        ({"state": [0.1]}, "/state", "2 numbers, here are 1: state.mass.s, rate.mass.s"),
        ({"state": [0.1, 0.0, -1.0]}, "/state", "positive in contact"),
        ({"state": [0.1, 0.0], "formulation": "lagrange"}, "/formulation", "joint coordinates"),
        ({"state": []}, "/state", "at least 1"),
    ],
)
def test_a_state_that_is_none_is_refused(changes, pointer, words) -> None:  # type: ignore[no-untyped-def]
    job = {"kind": "simulate", "scene": document(SOFT), "duration": 0.1}
    with pytest.raises(InvalidInput) as refused:
        admit(job | changes)
    (problem,) = refused.value.problems
    assert (problem.pointer, words in problem.detail) == (pointer, True)


def test_drivers_alone_leave_no_state_to_give() -> None:
    with pytest.raises(InvalidInput, match="Drivers alone"):
        admit(
            {
                "kind": "simulate",
                "scene": {"preset": "slider-crank", "parameters": {"clearance": 0.0}},
            }
            | {"duration": 0.1, "state": [0.0]}
        )


def test_companions_begin_in_the_contact_that_the_run_begins_in() -> None:
    """Other impact rates would be other motions, which no distance between companions tells."""
    scene, latched = document(SOFT), 0.12
    admission = admit(
        {"kind": "simulate", "scene": scene, "duration": 0.01, "state": [6e-4, 0.08, latched]}
    )
    assert isinstance(admission, Admission)
    kernel = ready_kernel(admission.scene, "reduced", admission.method)
    start = LaneStart.at_section(np.array(admission.job["state"]), kernel.states)
    problem = LaneProblem(admission.scene, 0.01, 1e-8, 0.01, 2, 0, 0.0, start=start)
    bundle = Bundle(kernel, [problem])
    Companions.beside(bundle, problem)
    for lane in map(bundle.lane, range(BUNDLE)):
        assert (lane["mode"][0], lane["impact_rate"][0]) == (1.0, latched)

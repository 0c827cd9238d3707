"""Steepness of laws at a journal that flies beside the wall of its bearing, in closed form."""

import numpy as np
import pytest

from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.runs.certificate.companions import RUN, TWIN, Companions
from jointplay.solver.runs.certificate.estimate import SAFETY
from jointplay.solver.runs.certificate.steepness import TOWARDS, steepness
from tests.solver.readable_mechanics import preset

CLEARANCE, STIFFNESS = 1e-3, 1e9
GAP, APART = 1e-7, 5e-8
"""m: the trajectory's gap, and by how much one companion's is less."""


def change(name: str, gap: float) -> float:
    """Return the steepness of a channel where one companion's gap is less by APART."""
    scene = preset("bouncing-journal", clearance=CLEARANCE, stiffness=STIFFNESS)
    problem = LaneProblem(scene, 1.0, 1e-6, 0.5, 3, 0, 0.0)
    kernel = ready_kernel(scene, "reduced")
    bundle = Bundle(kernel, [problem])
    companions = Companions.beside(bundle, problem)
    own = bundle.lane(RUN).row()
    down = kernel.row.state + kernel.coordinates.index("journal.y")
    own[:, down] = gap - CLEARANCE
    nearer = own.copy()
    nearer[:, down] -= APART
    companions.rows = {lane: [nearer if lane == TOWARDS[0] else own] for lane in (*TOWARDS, TWIN)}
    columns = np.array([kernel.rows.index(name)], dtype=np.int64)
    values = bundle.observe(RUN, own, columns)
    return float(steepness(companions, SAFETY, columns, values, np.array([True]))[0, 0])


def test_a_force_that_no_companion_feels_counts_within_the_bar_of_contact() -> None:
    depth = SAFETY * APART - GAP
    # Hertz's force at rest; the depth is a difference of lengths of 1e-3 m, known to 1e-19 m
    force = pytest.approx(STIFFNESS * depth**1.5, rel=1e-9)
    assert change("bearing.normal_force", GAP) == force


def test_a_force_out_of_reach_does_not_count() -> None:
    assert change("bearing.normal_force", 2.0 * SAFETY * APART) == 0.0


def test_what_follows_the_state_in_proportion_changes_as_much_as_it() -> None:
    assert change("journal.y", GAP) == pytest.approx(SAFETY * APART)

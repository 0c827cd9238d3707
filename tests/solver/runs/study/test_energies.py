"""Points that keep no works have all their other numbers, to the bit."""

from typing import Any

import pytest

from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kinds import admit, documents
from jointplay.solver.runs.study.problem import problem_of
from tests.solver.runs.study.jobs_of_studies import study
from tests.solver.runs.study.test_run import Computed

WORKS = {"driver_work", "contact_loss", "friction_loss", "gross_work", "energy_residual"}
CRANK: dict[str, Any] = {"preset": "slider-crank", "parameters": {"speed": 200.0}}
CLEARANCES = {"parameter": "clearance", "values": [1e-4, 4e-4]}
SWEEP = {"kind": "sweep", "scene": CRANK, "grid": {"clearance": [1e-4, 4e-4]}, "periods": 1.0}
BIFURCATION = {"kind": "bifurcation", "scene": CRANK, **CLEARANCES, "settle": 1, "record": 2}


@pytest.mark.parametrize("job", [SWEEP, BIFURCATION], ids=["sweep", "bifurcation"])
def test_without_energies_all_else_is_the_same(job: dict[str, Any]) -> None:
    kept, left_out = Computed(job), Computed(job | {"energies": False})
    for point, end in kept.ends.items():
        assert end.statistics.keys() - left_out.ends[point].statistics.keys() == WORKS
        assert end.statistics["gross_work"] > 0.0
        others = {name: end.statistics[name] for name in left_out.ends[point].statistics}
        assert repr(others) == repr(left_out.ends[point].statistics)
        assert end.peaks.tobytes() == left_out.ends[point].peaks.tobytes()


def test_maps_add_up_none() -> None:
    friction = {"parameter": "friction", "values": [0.0, 0.1]}
    chart = {"kind": "chart", "scene": CRANK, "along": CLEARANCES, "by": friction}
    assert not study(chart).keeps_ledger
    assert study(BIFURCATION).keeps_ledger


@pytest.mark.parametrize("energies", [True, False])
@pytest.mark.parametrize("job", [SWEEP, BIFURCATION], ids=["sweep", "bifurcation"])
def test_lanes_add_up_what_the_job_asks_for(job: dict[str, Any], energies: bool) -> None:
    asked = study(job, energies=energies)
    scene = asked.point_scene(0)
    kernel = ready_kernel(scene, asked.job["formulation"], asked.method)
    assert problem_of(asked, kernel, 0, scene).ledger == energies


def test_jobs_of_before_the_field_have_their_digests() -> None:
    assert admit(BIFURCATION).digest == admit(BIFURCATION | {"energies": True}).digest
    assert admit(BIFURCATION).digest != admit(BIFURCATION | {"energies": False}).digest
    filled = study(BIFURCATION).job
    old = {name: value for name, value in filled.items() if name != "energies"}
    assert documents.digest(old) == documents.digest(filled) == study(BIFURCATION).digest

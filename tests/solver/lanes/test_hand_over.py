"""Lanes that go on with another method in mid-run: what has counted and found goes on, too."""

import numpy as np

from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.loop.runs import Status
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.hand_over import handed_over
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.scene.document import Scene
from tests.solver.laws.thrown import pair, thrown

HARD = pair({"law": "power", "stiffness": 1e9}, {"law": "exact", "restitution": 0.5})
TOLERANCE, TIGHTER = 1e-7, 1e-9
DURATION = 0.02


def problem(tolerance: float) -> LaneProblem:
    return LaneProblem(Scene.model_validate(thrown(HARD)), DURATION, tolerance, 1e-3, 21, 0, 0.0)


def by(method: str, tolerance: float) -> Bundle:
    task = problem(tolerance)
    return Bundle(ready_kernel(task.scene, "minimal", method), [task])


def changed(bundle: Bundle) -> Bundle:
    task = problem(TIGHTER)
    kernel = ready_kernel(task.scene, "minimal", "rodas")
    return handed_over(bundle, kernel, task, TOLERANCE / TIGHTER)


def landed() -> Bundle:
    """Return a lane whose last step ended where contact begins, at a depth that is rounding."""
    bundle = by("tsitouras", TOLERANCE)
    lane = bundle.lane(0)
    while lane["mode"][0] == 0.0:
        bundle.advance(1)
    assert abs(lane["penetration"][0]) < 1e-15
    return bundle


def ended(bundle: Bundle) -> dict[str, np.ndarray]:
    """Return what a lane has counted and found by its end."""
    while bundle.advance(1000):
        pass
    lane, contacts = bundle.lane(0), bundle.impacts(0)
    assert lane.status == Status.DONE
    extremes = {name: lane[name].copy() for name in ("highest", "lowest")}
    impulses = contacts["impulse"].copy()
    return extremes | {"onsets": lane.run["onsets"].copy(), "impulses": impulses}


def test_contacts_and_extremes_are_those_of_the_other_method_alone() -> None:
    wanted, found = ended(by("rodas", TIGHTER)), ended(changed(landed()))
    assert found["onsets"] == wanted["onsets"] == len(wanted["impulses"]) > 1
    np.testing.assert_allclose(found["impulses"], wanted["impulses"], rtol=1e-4)
    for kind in ("highest", "lowest"):
        np.testing.assert_allclose(found[kind], wanted[kind], rtol=1e-4, atol=1e-7)


def test_values_where_the_last_step_ended_count_among_the_extremes() -> None:
    before = landed()
    values = before.lane(0)["previous"].copy()
    assert (values > before.lane(0)["highest"]).any()  # not yet counted
    after = changed(before).lane(0)
    assert (after["highest"] >= values).all()
    assert (after["lowest"] <= values).all()


def test_errors_are_judged_by_the_new_tolerance() -> None:
    before = landed()
    weight = before.lane(0)["weight"].copy()
    after = changed(before).lane(0)
    np.testing.assert_allclose(after["weight"], weight * (TOLERANCE / TIGHTER), rtol=1e-12)

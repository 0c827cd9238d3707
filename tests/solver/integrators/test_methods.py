"""Every integration method as lanes run it: its order on the press, and what ends its runs."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from jointplay.records.failure import SimulationFailed
from jointplay.solver.integrators import METHODS
from jointplay.solver.kernels import kernel_cache
from jointplay.solver.kernels.emit import enclosure
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.runs.results import Summary
from jointplay.solver.runs.simulate import Simulation
from jointplay.solver.scene.document import Scene

FLIGHT = 0.014
"""Seconds in which the press at 50 rad/s with room for 5 cm touches nothing: 0.7 rad."""


def press(duration: float, values: dict[str, float], **fields: Any) -> Admission:
    scene = {"preset": "seven-bar-press", "parameters": values}
    job = {"kind": "simulate", "scene": scene, "duration": duration, "certificate": False}
    admission = admit(fields | job)
    assert isinstance(admission, Admission)
    return admission


def flown(method: str, steps: int) -> NDArray[np.float64]:
    """Return the state of the press at the end of its flight, in that many equal steps."""
    values = {"speed": 50.0, "clearance": 0.05, "bearing_radius": 1.0}
    scene = press(FLIGHT, values).scene
    kernel = ready_kernel(scene, "reduced", method)
    step = FLIGHT / steps
    fixed = None if METHODS[method].error else step
    # tolerance 1: no step is refused
    bundle = Bundle(kernel, [LaneProblem(scene, FLIGHT, 1.0, FLIGHT, 0, 0, 0.0, step=fixed)])
    for name in ("step", "largest_step"):
        bundle.lane(0)[name] = step
    bundle.advance(10 * steps)
    assert bundle.lane(0).number("steps") == pytest.approx(
        steps, abs=1
    )  # rounding may add a sliver
    assert not bundle.lane(0)["mode"].any()
    return bundle.lane(0)["y"].copy()


@pytest.mark.parametrize(
    "method",
    [
        name if name == "tsitouras" else pytest.param(name, marks=pytest.mark.long)
        for name in METHODS
    ],
)
def test_before_the_first_contact_the_error_falls_with_the_order_of_the_method(
    method: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(enclosure, "TURN", 10.0)  # rad: one step may cross the whole flight
    monkeypatch.setattr(kernel_cache, "_kernels", {})
    exact = flown("dormand-prince-853", 12)
    order = METHODS[method].order
    # so many steps that the leading term of the error rules, so few that rounding does not: one
    # step of order eight leaves 8e-12, two leave 3e-14
    counts = {8: [1, 2], 5: [1, 2, 3, 4]}.get(order, [8, 12, 16, 24])
    errors = [np.abs(flown(method, n) - exact).max() for n in counts]
    slope = -np.polyfit(np.log(counts), np.log(errors), 1)[0]
    assert slope == pytest.approx(order, abs=0.5)


def finished(admission: Admission) -> Summary:
    simulation = Simulation(admission)
    for _ in simulation.slices():
        pass
    return simulation.summary()


def test_a_landing_that_does_not_converge_is_approached_in_shorter_steps() -> None:
    # at this tolerance, ten times what the method is admitted at, landings went in circles
    values = {"clearance": 4e-4}
    scene = Scene.model_validate(press(0.5, values).scene)
    kernel = ready_kernel(scene, "reduced", "bogacki-shampine")
    bundle = Bundle(kernel, [LaneProblem(scene, 0.5, 1e-3, 0.5, 0, 0, 0.0)])
    assert bundle.advance(20_000) == 0
    assert bundle.lane(0).time == pytest.approx(0.5)


@pytest.mark.long
def test_a_method_of_high_order_keeps_its_balance_where_tsitouras_is_refused() -> None:
    draft = finished(press(0.5, {"clearance": 5e-4}, accuracy="draft"))
    assert draft.statistics["method"] == "dormand-prince-853"
    energy = draft.statistics["energy"]
    assert abs(energy["residual"]) < 0.05 * (energy["contact_loss"] + energy["friction_loss"])


def test_a_fixed_step_of_200_microseconds_does_not_survive_the_first_contact() -> None:
    job = press(0.05, {"clearance": 5e-4}, method="rk4", step=2e-4)
    with pytest.raises(SimulationFailed) as failed:
        finished(job)
    assert failed.value.code == "fixed-step-too-long"
    assert "smaller 'step'" in failed.value.detail


def test_a_short_fixed_step_comes_to_the_first_impact_at_the_next_grid_point() -> None:
    step = 2e-6
    first = []
    for fields in ({"method": "rk4", "step": step}, {"accuracy": "fine"}):
        simulation = Simulation(press(0.0145, {"clearance": 5e-4}, **fields))
        onsets = [impact["onset"] for found in simulation.slices() for impact in found.impacts]
        first.append(min(onsets))
    assert 0.0 <= first[0] - first[1] <= step


def test_a_fixed_step_that_begins_contact_deep_is_told_the_energy_that_it_invents() -> None:
    # contact begins up to 50 um v deep: 4e-6 m at the first impact, with half a millijoule
    energy = finished(press(0.1, {"clearance": 5e-4}, method="rk4", step=5e-5)).statistics["energy"]
    assert abs(energy["residual"]) > 1e-4
    short = finished(press(0.1, {"clearance": 5e-4}, method="rk4", step=5e-6)).statistics["energy"]
    assert abs(short["residual"]) < abs(energy["residual"]) / 10.0

"""Works of kept steps: they add up to the energy ledger of the run."""

from typing import Any

import numpy as np
import pytest

from jointplay.records.works import WORKS
from jointplay.solver.kinds import admit
from jointplay.solver.runs.dense_output.columns import method_of
from jointplay.solver.runs.dense_output.replay import Replay
from jointplay.solver.runs.simulate import Simulation

LONG = pytest.mark.long
CASES = [
    pytest.param("seven-bar-press", 0.12, {}, id="press"),
    pytest.param("seven-bar-press", 0.02, {"method": "rodas"}, id="press, implicit"),
    pytest.param("bouncing-journal", 0.3, {}, id="journal"),
    *(
        pytest.param(name, duration, more, id=f"{name} {more}", marks=LONG)
        for name, duration in {
            "slider-crank": 0.2,
            "jansen-leg": 0.5,
            "driven-pendulum": 9.0,
            "impact-oscillator": 3.0,
            "quick-return": 0.5,
        }.items()
        for more in ({}, {"method": "rodas"}, {"formulation": "lagrange"})
    ),
    pytest.param("seven-bar-press", 0.02, {"method": "rk4", "step": 2e-6}, id="fixed", marks=LONG),
]


@pytest.mark.parametrize(("preset", "duration", "more"), CASES)
def test_works_of_all_steps_are_those_of_the_ledger(
    preset: str, duration: float, more: dict[str, Any]
) -> None:
    fields = {"kind": "simulate", "scene": {"preset": preset}, "duration": duration}
    simulation = Simulation(admit(fields | {"certificate": False} | more))
    rows = np.concatenate([piece.steps for piece in simulation.slices()])
    replay = Replay(simulation.admission, method_of(rows[0, -1]))
    works = replay.works(np.ascontiguousarray(rows[:, :-1]))
    assert works.shape == (len(rows), len(WORKS))
    ledger = simulation.summary().statistics["energy"]
    # a fixed step lets contacts begin deep, with a force that the step before does not see
    close = 1e-6 if "step" in more else 1e-10
    for name, found in zip(WORKS, works.sum(axis=0), strict=True):
        # the same numbers, added up in another order, but for the power at which a contact begins
        assert found == pytest.approx(ledger[name], abs=close * ledger["gross_work"]), name
    # what is lost at an instant is lost: no step gives energy back, but for its own error
    lost = works[:, :3]
    assert lost.min() >= -1e-6 * ledger["gross_work"]

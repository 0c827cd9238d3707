"""The energy ledger closes: what drivers and gravity put in is kept, or lost in contacts."""

from typing import Any

import numpy as np
import pytest

from tests.presets_given import REQUIRED
from tests.solver.completed_runs import CASE_3, run

Case = tuple[str, float, dict[str, Any], str]
CASES: dict[str, Case] = {
    "pendulum": ("pendulum", 3.0, {"angle": 1.0}, "reduced"),
    "bouncing": ("bouncing-journal", 0.2, {"velocity_x": 0.1, "spin": 30.0}, "reduced"),
    "slider-crank": ("slider-crank", 0.024, {}, "reduced"),
    "press": ("seven-bar-press", 0.5, CASE_3, "reduced"),
    "press with one loop closed": ("seven-bar-press", 0.5, {"clearance_B": 0.0}, "reduced"),
    "squeezer": ("andrews-squeezer", 0.05, {}, "reduced"),
    "oscillator": ("impact-oscillator", 2.0, {}, "reduced"),
    "press in absolute coordinates": ("seven-bar-press", 0.5, CASE_3, "lagrange"),
}


AT_LENGTH: dict[str, Case] = {
    "press with a step of friction": (
        "seven-bar-press",
        0.2,
        {**CASE_3, "static_velocity": 1e-3, "dynamic_velocity": 1e-3},
        "reduced",
    ),
    "double four-bar": ("double-four-bar", 3.0, {}, "reduced"),
    "quick return": ("quick-return", 0.3, {}, "reduced"),
    "double pendulum": ("double-pendulum", 3.0, {}, "reduced"),
    "driven pendulum": ("driven-pendulum", 5.0, {}, "reduced"),
    "four-bar": ("four-bar", 0.1, {}, "reduced"),
    "five four-bars": ("n-four-bar", 1.0, {}, "reduced"),
    "leg": ("jansen-leg", 0.5, {}, "reduced"),
    "test bed": ("seven-bar-test-bed", 0.2, REQUIRED["seven-bar-test-bed"], "reduced"),
}
"""Cases that take long, or kernels that the short run does not compile."""


@pytest.mark.parametrize("tolerance", [1e-6, pytest.param(1e-8, marks=pytest.mark.long)])
@pytest.mark.parametrize(
    "case", [*CASES, *(pytest.param(name, marks=pytest.mark.long) for name in AT_LENGTH)]
)
def test_the_residual_of_the_ledger_is_small_against_the_work_done(
    case: str, tolerance: float
) -> None:
    name, duration, parameters, formulation = {**CASES, **AT_LENGTH}[case]
    found = run(
        name,
        duration,
        parameters=parameters,
        tolerance=tolerance,
        formulation=formulation,
    )
    ledger = found.statistics["energy"]
    assert abs(ledger["residual"]) <= 10.0 * tolerance * ledger["gross_work"]


def test_gross_work_counts_what_comes_back() -> None:
    # no loss: gravity, then the contact, take and give the same energy m g (c + delta)
    weight, clearance, stiffness = 9.81, 1e-3, 1e9
    found = run(
        "bouncing-journal",
        0.025,
        parameters={"restitution": 1.0, "friction": 0.0},
        tolerance=1e-10,
    )
    assert len(found.contacts("bearing")) == 1
    depth = 0.0
    for _ in range(20):
        depth = (2.5 * weight * (clearance + depth) / stiffness) ** 0.4
    drop = clearance + depth
    risen = found["journal.y"][-1] + drop
    # the step of about 2e-2 of the contact in which it turns counts only what it comes to: at most
    # (pi / 4 * 2e-2)^2 = 2.5e-4 of the contact's work is left out
    assert found.statistics["energy"]["gross_work"] == pytest.approx(
        weight * (3.0 * drop + risen), rel=3e-4
    )


@pytest.mark.parametrize("case", ["bouncing", "slider-crank", "press"])
def test_contacts_and_friction_only_lose(case: str) -> None:
    name, duration, parameters, formulation = CASES[case]
    found = run(name, duration, parameters=parameters, tolerance=1e-8, formulation=formulation)
    ledger = found.statistics["energy"]
    assert ledger["contact_loss"] > 0.0
    assert ledger["friction_loss"] > 0.0


def test_an_elastic_bearing_without_friction_keeps_all_energy() -> None:
    found = run(
        "bouncing-journal",
        0.3,
        parameters={"restitution": 1.0, "friction": 0.0},
        tolerance=1e-10,
    )
    ledger = found.statistics["energy"]
    assert found.statistics["onsets"] >= 5
    assert ledger["friction_loss"] == 0.0
    assert abs(ledger["contact_loss"]) < 1e-7 * 0.01
    # the journal drops 1 mm: 10 mJ are exchanged at every bounce; a thousand tolerances of them
    assert abs(ledger["residual"]) < 1e-7 * 0.01


def test_gravity_work_is_the_change_of_potential_energy() -> None:
    found = run("pendulum", 1.0, parameters={"angle": 1.0}, tolerance=1e-9)
    potential = found["energy.potential"]
    assert found.statistics["energy"]["gravity_work"] == pytest.approx(
        potential[0] - potential[-1], abs=1e-12
    )
    np.testing.assert_allclose(potential, 9.81 * found["rod.y"], rtol=1e-13)


def test_friction_as_published_may_feed_energy_and_the_ledger_says_so() -> None:
    # eqs 5-7 leave the spin of the bodies out, so friction can act along the material slip
    found = run(
        "seven-bar-press",
        0.5,
        parameters={**CASE_3, "slip_velocity": "as-published", "stiffness": None},
        tolerance=1e-8,
    )
    ledger = found.statistics["energy"]
    assert abs(ledger["residual"]) <= 10.0 * 1e-8 * ledger["gross_work"]

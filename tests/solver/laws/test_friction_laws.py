"""Friction laws as kernels compute them, and the values that their sources name."""

from typing import Any

import numpy as np
import pytest

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit
from jointplay.solver.laws.friction import LAWS
from tests.solver.completed_runs import run
from tests.solver.laws.thrown import spinning

BREAKAWAY = {"static_coefficient": 0.3, "kinetic_coefficient": 0.2}
NUMBERS: dict[str, dict[str, Any]] = {
    "modified-coulomb": {"coefficient": 0.2, "static_velocity": 0.05, "dynamic_velocity": 0.5},
    "threlfall": {"coefficient": 0.2, "full_velocity": 0.5},
    "bengisu-akay": BREAKAWAY | {"static_velocity": 0.5, "decay": 2.0},
    "stribeck": BREAKAWAY | {"stribeck_velocity": 1.0, "smoothing_velocity": 0.5},
    "brown-mcphee": BREAKAWAY | {"transition_velocity": 0.5},
    "dahl": {"coefficient": 0.2, "bristle_stiffness": 100.0},
    "lugre": BREAKAWAY
    | {
        "stribeck_velocity": 1.0,
        "bristle_stiffness": 100.0,
        "bristle_damping": 0.05,
        "viscous_damping": 0.01,
    },
}
CONTACT = {"law": "lankarani-nikravesh", "stiffness": 1e8, "restitution": 0.9}


@pytest.mark.long
def test_friction_acts_in_kernels_as_it_is_written() -> None:
    assert NUMBERS.keys() == LAWS.keys()
    scene = spinning(CONTACT, *({"law": name} | numbers for name, numbers in NUMBERS.items()))
    found = run(scene, 0.02, tolerance=1e-7, output_step=2e-5)
    energy = found.statistics["energy"]
    assert energy["friction_loss"] > 0.01
    # what is promised: 10 * tolerance * gross work
    assert abs(energy["residual"]) < 10.0 * 1e-7 * energy["gross_work"]
    for journal, (name, numbers) in enumerate(NUMBERS.items()):
        law = LAWS[name].model_validate(numbers)
        names = ["normal_force", "slip_velocity", *(x.name for x in law.inner_states)]
        columns = np.array([found[f"bearing{journal}.{column}"] for column in names]).T
        force = found[f"bearing{journal}.friction_force"]
        touching = np.flatnonzero(columns[:, 0] > 0.0)
        assert len(touching) > 10
        slips = columns[touching, 1]
        assert np.ptp(slips) > 0.1  # the curve is gone through, not seen at one point
        for at in touching:
            normal, slip, *inner = columns[at].tolist()
            # exponentials of our own, to 1e-15 of the coefficient
            assert force[at] == pytest.approx(
                law.friction_force(normal, slip, inner), rel=1e-9, abs=1e-12 * normal
            )


def coefficient(name: str, slip: float, inner: tuple[float, ...] = ()) -> float:
    """Return the friction force by the normal force, against the slip."""
    return -float(LAWS[name].model_validate(NUMBERS[name]).friction_force(1.0, slip, inner))


def test_curves_go_through_the_values_that_define_them() -> None:
    # full at v_r, where the source says 0.95, and not more beyond
    assert coefficient("threlfall", 0.5) == pytest.approx(0.95 * 0.2, rel=3e-4)
    assert coefficient("threlfall", 5.0) == coefficient("threlfall", 0.5)
    # static at v_0, kinetic far beyond, three quarters of static at half of v_0
    assert coefficient("bengisu-akay", 0.5) == pytest.approx(0.3, rel=1e-12)
    assert coefficient("bengisu-akay", 0.25) == pytest.approx(0.75 * 0.3, rel=1e-12)
    assert coefficient("bengisu-akay", 1.0) == pytest.approx(0.2 + 0.1 * np.exp(-1.0), rel=1e-12)
    assert coefficient("stribeck", 1.0) == pytest.approx(
        (0.2 + 0.1 * np.exp(-1.0)) * np.tanh(2.0), rel=1e-12
    )
    assert coefficient("stribeck", 20.0) == pytest.approx(0.2, rel=1e-12)
    # at the transition velocity the second term is the whole surplus
    assert coefficient("brown-mcphee", 0.5) == pytest.approx(0.2 * np.tanh(4.0) + 0.1, rel=1e-12)
    assert coefficient("brown-mcphee", 500.0) == pytest.approx(0.2, rel=1e-6)


@pytest.mark.parametrize("slip", [0.1, 1.0, 3.0])
def test_bristles_that_slide_steadily_give_the_curve_of_stribeck(slip: float) -> None:
    law = LAWS["lugre"].model_validate(NUMBERS["lugre"])
    full = 0.2 + 0.1 * np.exp(-(slip**2))
    bent = (full / 100.0,)
    (rate,) = law.inner_rates(1.0, slip, bent)
    assert rate == pytest.approx(0.0, abs=1e-15)
    assert coefficient("lugre", slip, bent) == pytest.approx(full + 0.01 * slip, rel=1e-12)


def test_a_kinetic_coefficient_above_the_static_one_is_refused() -> None:
    law = {"law": "stribeck", "static_coefficient": 0.1, "kinetic_coefficient": 0.2}
    with pytest.raises(InvalidInput) as refused:
        admit({"kind": "simulate", "scene": spinning(CONTACT, law), "duration": 1e-3})
    (found,) = refused.value.problems
    assert found.pointer == "/scene/joints/bearing0/clearance/friction/kinetic_coefficient"
    assert "(0.2) is above the static one (0.1)" in found.detail


@pytest.mark.parametrize(("smoothing", "reached"), [(0.1, 0.968), (0.01, 0.999)])
def test_a_smoothed_stribeck_curve_stays_below_the_static_force_as_it_says(
    smoothing: float, reached: float
) -> None:
    numbers = NUMBERS["stribeck"] | {"smoothing_velocity": smoothing}
    slips = np.linspace(0.0, 2.0, 2001)[1:]
    law = LAWS["stribeck"].model_validate({"law": "stribeck"} | numbers)
    largest = max(-float(law.friction_force(1.0, slip)) for slip in slips)
    assert largest / 0.3 == pytest.approx(reached, abs=5e-4)
    assert f"{reached}" in (LAWS["stribeck"].__doc__ or "")

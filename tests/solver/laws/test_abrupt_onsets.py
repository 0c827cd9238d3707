"""Forces that jump where a contact begins, or grow as a root of time, at the best accuracy."""

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.solver.completed_runs import run


def thrown(
    mass: float, clearance: float, stiffness: float, speed: float, dissipation: dict[str, Any]
) -> dict[str, Any]:
    """Return a scene in which a weightless journal is thrown at its bearing."""
    contact = {
        "law": "stiffness-and-dissipation",
        "stiffness": {"law": "power", "stiffness": stiffness, "exponent": 1.5},
        "dissipation": dissipation,
    }
    clearances = {
        "radial_clearance": clearance,
        "bearing_radius": 20.0 * clearance,
        "contact": contact,
    }
    joint = {"type": "revolute", "bearing": "ground.O", "journal": "j.c", "clearance": clearances}
    return {
        "name": "thrown",
        "gravity": [0.0, 0.0],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"j": {"mass": mass, "inertia": 1e-4 * mass, "points": {"c": [0.0, 0.0]}}},
        "joints": {"B": joint},
        "start": {"velocities": {"j": [speed, 0.0]}},
    }


def test_a_force_that_grows_as_a_root_of_time_is_followed_at_reference() -> None:
    mass = 0.000194039362
    law = {"law": "jankowski", "restitution": 0.01, "effective_mass": mass}
    scene = thrown(mass, 3.64738084e-05, 6674355958.082784, 2.79007271, law)
    found = run(scene, 4.3924160285007247e-05, accuracy="reference")
    # an integration of one body by an implicit method
    assert found.peaks["B.normal_force"].maximum == pytest.approx(4998.1490, rel=1e-7)


@pytest.mark.parametrize(
    ("mass", "clearance", "stiffness", "speed", "damping"),
    [
        (1.07e-3, 1.62e-5, 1.9e10, 3.03, 300.0),
        (1.0e-5, 1.35e-5, 3.8e8, 1.66, 0.4),
        (5.5e-3, 3.33e-5, 2.8e9, 0.281, 60.0),
    ],
)
def test_a_force_that_jumps_at_onset_is_followed_at_reference(
    mass: float, clearance: float, stiffness: float, speed: float, damping: float
) -> None:
    """A damper that is there at once delivers the impulse of an integration that begins in it."""
    law = {"law": "kelvin-voigt", "damping": damping}
    depth = (1.25 * mass * speed**2 / stiffness) ** 0.4
    end = 20.0 * depth / speed
    scene = thrown(mass, clearance, stiffness, speed, law)
    found = run(scene, clearance / speed + end, accuracy="reference")
    contact = found.contacts("B")[0]

    def force(state: Any) -> Any:
        return max(stiffness * max(state[0], 0.0) ** 1.5 + damping * state[1], 0.0)

    def gap(t: float, state: Any) -> float:
        return float(state[0])

    gap.terminal, gap.direction = True, -1.0  # type: ignore[attr-defined]  # SciPy reads them
    solution = solve_ivp(
        lambda t, state: [state[1], -force(state) / mass],
        (0.0, end),
        [0.0, speed],
        method="DOP853",
        rtol=1e-12,
        atol=1e-18,
        max_step=end / 2000.0,
        events=gap,
    )
    impulse = mass * (speed - solution.y[1, -1])
    assert contact["impulse"] == pytest.approx(impulse, rel=1e-7)
    peak = max(force(state) for state in np.transpose(solution.y))
    assert contact["peak_force"] == pytest.approx(peak, rel=1e-4)


def test_a_force_that_jumps_far_is_not_approached_by_ever_shorter_steps() -> None:
    """A damper stops a journal in 1e-9 s; the slopes before its onset ask for steps of 1e-19 s."""
    mass, clearance, speed = 1e-3, 1e-5, 1.0
    scene = thrown(mass, clearance, 1e8, speed, {"law": "kelvin-voigt", "damping": 1e6})
    found = run(scene, 1e-4, accuracy="reference")
    assert found.contacts("B")[0]["impulse"] == pytest.approx(mass * speed, rel=1e-9)
    assert found.statistics["smallest_step"] > 1e-13


@pytest.mark.parametrize("method", ["tsitouras", "bogacki-shampine", "dormand-prince-853"])
def test_the_largest_force_of_a_contact_is_that_just_behind_its_onset(method: str) -> None:
    """It was that at a quarter of the first step, or at its end: up to 2 % less."""
    damping, speed = 60.0, 0.5
    scene = thrown(1e-2, 1e-3, 1e4, speed, {"law": "kelvin-voigt", "damping": damping})
    (contact,) = run(scene, 0.01, method=method, tolerance=1e-6).contacts("B")
    assert contact["peak_force"] == pytest.approx(damping * speed, rel=1e-6)

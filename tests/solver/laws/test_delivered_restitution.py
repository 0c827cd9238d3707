"""Restitution that each dissipation law delivers in free impacts, and the forces on the way."""

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from benchmarks import restitution
from jointplay.solver.laws.contact import ContactLaw
from jointplay.solver.laws.delivered import ASKED, DELIVERED
from jointplay.solver.laws.dissipation import LAWS
from jointplay.solver.laws.dissipation.latched import Latched
from jointplay.solver.scene.references import tangent_obstacle
from tests.solver.completed_runs import Run, run
from tests.solver.laws.made_dissipation import made
from tests.solver.laws.thrown import CLEARANCE, MASS, SPEED, admitted, pair, thrown
from tests.solver.runs.study.test_run import Computed

TABLE = {
    "exact": ASKED,
    "none": (1.0,) * 8,
    "lankarani-nikravesh": (0.6653, 0.6842, 0.7252, 0.7960, 0.8471, 0.9132, 0.9535, 0.9901),
    "hunt-crossley": (0.5158, 0.5813, 0.6630, 0.7680, 0.8329, 0.9090, 0.9524, 0.9901),
    "herbert-mcwhannell": (0.4907, 0.5200, 0.5936, 0.7227, 0.8070, 0.9009, 0.9501, 0.9900),
    "lee-wang": (0.6867, 0.7390, 0.7992, 0.8693, 0.9090, 0.9524, 0.9756, 0.9950),
    "zhiying-qishao": (0.2175, 0.3267, 0.4826, 0.6796, 0.7874, 0.8959, 0.9489, 0.9900),
    "flores": (0.0694, 0.2562, 0.4704, 0.6832, 0.7885, 0.8939, 0.9468, 0.9893),
    "hu-guo": (0.0741, 0.2707, 0.4877, 0.6973, 0.7992, 0.8999, 0.9500, 0.9900),
    "gonthier": (0.1010, 0.3042, 0.4877, 0.6696, 0.7680, 0.8764, 0.9359, 0.9868),
    "gharib-hurmuzlu": (0.1000, 0.2819, 0.4107, 0.5008, None, 0.5668, None, None),
    "safaeifar-farshidianfar": (0.0889, 0.3138, 0.5362, 0.7350, None, 0.9152, None, None),
    "jankowski": (None, 0.2917, 0.4946, 0.6977, None, 0.8997, None, None),
    "tsuji": (0.2527, 0.3971, 0.5503, 0.7182, None, 0.9020, None, None),
}
"""Delivered in free impact for each restitution asked, to four figures: of the integral of energy
where damping is a multiple of the elastic force, else of an independent integration."""
ONE_KERNEL = [name for name, law in LAWS.items() if issubclass(law, Latched)]
"""Laws whose equations are the same, but for numbers that are evaluated outside of the kernel."""


def job(name: str) -> dict[str, Any]:
    """Return a job that throws a journal at its bearing once for each restitution asked."""
    scene = thrown(pair({"law": "power", "stiffness": 1e9}, made(name).model_dump()))
    place = "/joints/bearing0/clearance/contact/dissipation/restitution"
    scene["parameters"] = {"asked": {"help": "Restitution.", "targets": [{"path": place}]}}
    return {
        "kind": "sweep",
        "scene": scene,
        "grid": {"asked": list(ASKED)},
        "duration": 2.9 * CLEARANCE / SPEED,
        "tolerance": 1e-8,
        "channels": ["journal0.vx"],
    }


def delivered(name: str) -> list[float]:
    """Return what the solver's impacts give back of the speed, for each restitution asked."""
    ends = Computed(job(name)).ends
    return [-float(ends[point].peaks[0, 0]) / SPEED for point in range(len(ASKED))]


@pytest.mark.parametrize("name", ONE_KERNEL)
def test_free_impacts_deliver_what_the_integral_of_energy_says(name: str) -> None:
    for asked, shown, found in zip(ASKED, DELIVERED[name], delivered(name), strict=True):
        chi = made(name, restitution=asked).hysteresis()
        # tolerance 1e-8 of local error over some sixty steps
        left = chi * (1.0 + found) - math.log((1.0 + chi) / (1.0 - chi * found))
        assert left == pytest.approx(0.0, abs=2e-6 * (1.0 + chi) / (1.0 - chi * found))
        assert found == pytest.approx(shown, abs=5.1e-5)


def test_what_is_shown_as_delivered_is_what_is_known() -> None:
    assert DELIVERED.keys() == {n for n, law in LAWS.items() if "restitution" in law.model_fields}
    for name, row in TABLE.items():
        for known, shown in zip(row, DELIVERED.get(name, row), strict=True):
            assert known in (None, pytest.approx(shown, abs=1.01e-4))  # a last figure either way


@pytest.mark.long
@pytest.mark.parametrize("name", DELIVERED)
def test_what_is_shown_as_delivered_is_what_the_command_measures(name: str) -> None:
    for asked, shown in zip(ASKED, DELIVERED[name], strict=True):
        assert restitution.delivered(name, asked) == pytest.approx(shown, abs=5.1e-5)


JOURNALS = [
    pair({"law": "hertz-spheres"}, {"law": "tsuji", "restitution": 0.5, "effective_mass": MASS}),
    pair(
        {"law": "power", "stiffness": 1e9},
        {"law": "jankowski", "restitution": 0.5, "effective_mass": MASS},
    ),
    pair({"law": "power", "stiffness": 1e9}, {"law": "kuwabara-kono", "relaxation_time": 1e-5}),
    pair(
        {"law": "power", "stiffness": 1e7, "exponent": 1.0},
        {"law": "kelvin-voigt", "damping": 1e3},
    ),
    pair({"law": "power", "stiffness": 1e9}, {"law": "hunt-crossley-unlatched", "loss": 1.0}),
    pair({"law": "johnson"}, {"law": "exact", "restitution": 0.3}),
    pair({"law": "pereira"}, {"law": "hu-guo", "restitution": 0.5}),
    pair({"law": "liu"}, {"law": "none"}),
    {
        "law": "adams-impact",
        "stiffness": 1e9,
        "damping": 1e3,
        "full_damping_depth": 1e-5,
    },
]
KNOWN = {0: 0.5503, 1: 0.4946, 5: 0.3, 6: 0.4877, 7: 1.0}
"""Values of the table above, by journal."""


@cache
def thrown_together() -> Run:
    """Throw journals with laws of every form at their bearings, in one run of one kernel."""
    duration = 2.9 * CLEARANCE / SPEED
    return run(thrown(*JOURNALS), duration, tolerance=1e-9, output_step=1e-5)


def returned(law: ContactLaw, fit: Any) -> float:
    """Return the speed that a journal gives back, by an integration of the law as it is written."""

    def slope(_: float, y: Any) -> list[float]:
        return [y[1], -law.normal_force(fit, y[0], y[1], SPEED) / MASS]

    def left(_: float, y: Any) -> float:
        return float(y[0])

    left.terminal, left.direction = True, -1  # type: ignore[attr-defined]
    span, first = (0.0, 0.1), [1e-15, SPEED]
    ended = solve_ivp(slope, span, first, "DOP853", rtol=1e-9, atol=1e-14, events=left)
    return -float(ended.y[1, -1])


@pytest.mark.parametrize("journal", range(len(JOURNALS)))
@pytest.mark.long
def test_laws_of_every_form_act_as_they_are_written(journal: int) -> None:
    found = thrown_together()
    fit = found.admission.scene.joints[f"bearing{journal}"].clearance
    law = fit.contact
    # local errors of 1e-9 over some fifty steps a contact; the other program's are alike
    speed = -found.peaks[f"journal{journal}.vx"].minimum
    assert speed == pytest.approx(returned(law, fit), abs=1e-6 * SPEED)
    if journal in KNOWN:
        assert speed / SPEED == pytest.approx(KNOWN[journal], abs=5.1e-5)
    depth, force = (found[f"bearing{journal}.{name}"] for name in ("penetration", "normal_force"))
    touching = force > 0.0
    assert touching.sum() > 4
    for at in np.flatnonzero(touching):
        exact = law.normal_force(fit, depth[at], found[f"journal{journal}.vx"][at], SPEED)
        # a depth is the difference of an eccentricity and the clearance
        assert force[at] == pytest.approx(exact, rel=1e-9, abs=1e-6)


def test_a_tangent_follows_the_forces_that_do_not_jump() -> None:
    jumping = {i: tangent_obstacle(admitted(law)) for i, law in enumerate(JOURNALS)}
    assert {i for i, words in jumping.items() if words} == {3}
    assert "'power with kelvin-voigt' jumps where a contact begins" in jumping[3]
    line = pair({"law": "johnson"}, {"law": "kuwabara-kono", "relaxation_time": 1e-6})
    assert "'johnson with kuwabara-kono' jumps" in tangent_obstacle(admitted(line))

"""Every dissipation law: what all of them must do, and what restitution each delivers."""

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from benchmarks import restitution
from jointplay.records.failure import InvalidInput
from jointplay.solver.kernels.record.recorder import Recorder
from jointplay.solver.kinds import admit
from jointplay.solver.laws.contact import ContactLaw
from jointplay.solver.laws.delivered import ASKED, DELIVERED
from jointplay.solver.laws.dissipation import LAWS, Dissipation, Elastic
from jointplay.solver.laws.dissipation.exact import inverse_langevin
from jointplay.solver.laws.dissipation.latched import Latched
from jointplay.solver.laws.stiffness import LAWS as STIFFNESS_LAWS
from jointplay.solver.laws.stiffness import Stiffness
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.references import tangent_obstacle
from tests.solver.completed_runs import Run, run
from tests.solver.kernels.test_recorder import evaluate
from tests.solver.laws.specification.contact import FIT, Fit, depths, impact_rates
from tests.solver.laws.specification.member import documented, rates
from tests.solver.laws.specification.units import ROUNDING, Units, rescaled, some_units
from tests.solver.laws.thrown import CLEARANCE, MASS, SPEED, pair, thrown
from tests.solver.runs.study.test_run import Computed

STIFFNESSES = [
    STIFFNESS_LAWS["power"].model_validate({"stiffness": 1e10}),
    STIFFNESS_LAWS["power"].model_validate({"stiffness": 1e9, "exponent": 1.0}),
    STIFFNESS_LAWS["johnson"](),
    STIFFNESS_LAWS["liu"](),
]
NUMBERS = {
    "restitution": 0.6,
    "effective_mass": 2.0,
    "damping": 1e3,
    "relaxation_time": 1e-5,
    "loss": 0.2,
}


def made(name: str, **numbers: float) -> Dissipation:
    """Return a law with the numbers above, or others, as far as it has such parameters."""
    fields = LAWS[name].model_fields
    given_ones = {key: value for key, value in (NUMBERS | numbers).items() if key in fields}
    return LAWS[name].model_validate(given_ones)


each = pytest.mark.parametrize("law", [made(name) for name in LAWS], ids=lambda law: law.law)
stiffnesses = st.sampled_from(STIFFNESSES)


@each
def test_it_cites_its_source_and_says_where_it_fails(law: Dissipation) -> None:
    documented(type(law))
    assert LAWS[law.law] is type(law)


@each
@given(stiffness=stiffnesses, depth=depths, rate=rates, impact_rate=impact_rates)
def test_it_resists_the_rate_and_is_the_elastic_force_at_rest(
    law: Dissipation, stiffness: Stiffness, depth: float, rate: float, impact_rate: float
) -> None:
    elastic = Elastic(stiffness, FIT, depth)
    force = law.normal_force(elastic, rate, impact_rate)
    assert (force - elastic.force) * rate >= 0.0
    assert law.normal_force(elastic, 0.0, impact_rate) == elastic.force
    for apart in (0.0, -depth):
        assert law.normal_force(Elastic(stiffness, FIT, apart), rate, impact_rate) == 0.0


@each
@pytest.mark.parametrize("stiffness", STIFFNESSES, ids=lambda law: f"{law.law}")
def test_it_says_whether_the_force_jumps_at_an_onset(
    law: Dissipation, stiffness: Stiffness
) -> None:
    begun, later = (
        law.normal_force(Elastic(stiffness, FIT, depth), 0.1, 0.1) for depth in (1e-18, 1e-6)
    )
    # forces grow as the fourth root of the depth at least, or by a factor of four as logarithms
    assert (begun > 0.03 * later) == law.jumps_at_onset(stiffness)


@each
@given(rate=rates, impact_rate=impact_rates)
def test_it_says_whether_it_remembers_the_impact_rate(
    law: Dissipation, rate: float, impact_rate: float
) -> None:
    elastic = Elastic(STIFFNESSES[0], FIT, 1e-5)
    forces = {law.normal_force(elastic, 1.0 + abs(rate), r) for r in (impact_rate, 3.0)}
    assert (len(forces) > 1) == (law.least_impact_rate > 0.0)


@each
@given(stiffness=stiffnesses, units=some_units, depth=depths, rate=rates, impact_rate=impact_rates)
def test_it_is_dimensionally_homogeneous(
    law: Dissipation,
    stiffness: Stiffness,
    units: Units,
    depth: float,
    rate: float,
    impact_rate: float,
) -> None:
    here = Elastic(stiffness, FIT, depth)
    fit = Fit(*(units.m * length for length in FIT))
    there = Elastic(rescaled(stiffness, units), fit, depth * units.m)
    newton, speed = units.of("N", stiffness), units.of("m/s", stiffness)
    force = law.normal_force(here, rate, impact_rate)
    scaled = rescaled(law, units).normal_force(there, rate * speed, impact_rate * speed)
    # the difference of elastic and damping parts keeps their rounding
    size = here.force + abs(force - here.force)
    assert scaled == pytest.approx(force * newton, abs=1e4 * ROUNDING * size * newton)


@each
def test_it_is_recorded_as_it_is_written(law: Dissipation) -> None:
    recorder = Recorder()
    numbers = {
        name: recorder.number(name, value)
        for name, value in law.model_dump().items()
        if isinstance(value, float)
    }
    seen = type(law).model_construct(**{**law.model_dump(), **numbers})
    depth, rate, impact = (recorder.variable(name) for name in ("depth", "rate", "impact"))
    for stiffness in STIFFNESSES:
        node = recorder.lift(seen.normal_force(Elastic(stiffness, FIT, depth), rate, impact))
        for here in (-1e-6, 0.0, 1e-9, 1e-5):
            for speed in (-0.1, 0.3):
                values = {"depth": here, "rate": speed, "impact": 0.2}
                found = evaluate(node, recorder.numbers | values, {})
                exact = law.normal_force(Elastic(stiffness, FIT, here), speed, 0.2)
                assert found == pytest.approx(exact, rel=1e-12)


# what it delivers

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
"""Of the table above, by journal."""


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


def admitted(law: dict[str, Any]) -> Scene:
    return admit({"kind": "simulate", "scene": thrown(law), "duration": 1e-3}).scene


@given(st.floats(0.0, 0.999))
def test_langevins_function_is_inverted(y: float) -> None:
    x = inverse_langevin(y)
    # coth x - 1 / x itself loses digits where x is small
    expected = 1.0 / math.tanh(x) - 1.0 / x if x > 1e-3 else x / 3.0
    assert expected == pytest.approx(y, rel=1e-7, abs=1e-12)


def test_wrong_parts_of_a_law_are_refused_where_they_are() -> None:
    for law, field, words in (
        (pair({"law": "power"}, {"law": "none"}), "stiffness/stiffness", "required"),
        (pair({"law": "jonson"}, {"law": "none"}), "stiffness/law", "'johnson'"),
        (pair({"law": "liu"}, {"law": "exact", "restitution": 0.0}), "dissipation/restitution", ""),
        (
            pair({"law": "liu"}, {"law": "tsuji", "restitution": 0.5}),
            "dissipation/effective_mass",
            "",
        ),
        (
            pair({"law": "power", "stiffness": -1.0}, {"law": "none"}),
            "stiffness/stiffness",
            "greater than 0 N/m^n",
        ),
        (
            pair({"law": "liu", "poisson": 0.3}, {"law": "none"}),
            "stiffness/poisson",
            "law, poisson_ratio, youngs_modulus",
        ),
    ):
        with pytest.raises(InvalidInput) as refused:
            admitted(law)
        (found,) = refused.value.problems
        assert found.pointer == f"/scene/joints/bearing0/clearance/contact/{field}"
        assert words in found.detail

"""Every dissipation law: what all of them must do."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from jointplay.records.failure import InvalidInput
from jointplay.solver.kernels.trace.tracer import Tracer
from jointplay.solver.laws.dissipation import LAWS, Dissipation, Elastic
from jointplay.solver.laws.dissipation.exact import inverse_langevin
from jointplay.solver.laws.stiffness import LAWS as STIFFNESS_LAWS
from jointplay.solver.laws.stiffness import Stiffness
from tests.solver.kernels.test_tracer import evaluate
from tests.solver.laws.made_dissipation import made
from tests.solver.laws.specification.contact import FIT, Fit, depths, impact_rates
from tests.solver.laws.specification.member import documented, rates
from tests.solver.laws.specification.units import ROUNDING, Units, rescaled, some_units
from tests.solver.laws.thrown import admitted, pair

STIFFNESSES = [
    STIFFNESS_LAWS["power"].model_validate({"stiffness": 1e10}),
    STIFFNESS_LAWS["power"].model_validate({"stiffness": 1e9, "exponent": 1.0}),
    STIFFNESS_LAWS["johnson"](),
    STIFFNESS_LAWS["liu"](),
]


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
    assert (len(forces) > 1) == (law.least_impact_rate != 0.0)


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
def test_it_is_traced_as_it_is_written(law: Dissipation) -> None:
    tracer = Tracer()
    numbers = {
        name: tracer.number(name, value)
        for name, value in law.model_dump().items()
        if isinstance(value, float)
    }
    seen = type(law).model_construct(**{**law.model_dump(), **numbers})
    depth, rate, impact = (tracer.variable(name) for name in ("depth", "rate", "impact"))
    for stiffness in STIFFNESSES:
        node = tracer.lift(seen.normal_force(Elastic(stiffness, FIT, depth), rate, impact))
        for here in (-1e-6, 0.0, 1e-9, 1e-5):
            for speed in (-0.1, 0.3):
                values = {"depth": here, "rate": speed, "impact": 0.2}
                found = evaluate(node, tracer.numbers | values, {})
                exact = law.normal_force(Elastic(stiffness, FIT, here), speed, 0.2)
                assert found == pytest.approx(exact, rel=1e-12)


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

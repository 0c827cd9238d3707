"""What every contact law and every friction law must do, whichever it is."""

from __future__ import annotations

import inspect
import math
import re
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.integrate import quad

from jointplay.solver.laws.contact import LAWS as CONTACT_LAWS
from jointplay.solver.laws.contact.lankarani_nikravesh import contact_stiffness
from jointplay.solver.laws.friction import LAWS as FRICTION_LAWS
from jointplay.solver.quantities.units import Strict

contact_law = pytest.mark.parametrize("law", CONTACT_LAWS.values(), ids=list(CONTACT_LAWS))
friction_law = pytest.mark.parametrize("law", FRICTION_LAWS.values(), ids=list(FRICTION_LAWS))

ROUNDING = 1e-13
"""A law is about ten operations, and a power of a large ratio amplifies a rounding tenfold."""

exponents = st.one_of(st.just(1.5), st.floats(1.0, 3.0))
restitutions = st.floats(0.0, 1.0)
depths = st.floats(1e-9, 1e-3)
rates = st.floats(-2.0, 2.0)
impact_rates = st.floats(1e-3, 2.0)


def parameters(law: ModuleType, **values: Any) -> SimpleNamespace:
    """Return a law's numbers: its defaults, and the values given."""
    (model,) = (
        item
        for _, item in inspect.getmembers(law, inspect.isclass)
        if issubclass(item, Strict) and item is not Strict
    )
    return SimpleNamespace(**model.model_validate(values).model_dump())


def model_docstring(law: ModuleType) -> str:
    (model,) = (
        item
        for _, item in inspect.getmembers(law, inspect.isclass)
        if issubclass(item, Strict) and item is not Strict
    )
    return inspect.getdoc(model) or ""


# contact


@contact_law
@given(restitution=restitutions, exponent=exponents, rate=rates, impact_rate=impact_rates)
def test_there_is_no_contact_force_at_zero_depth(
    law: ModuleType, restitution: float, exponent: float, rate: float, impact_rate: float
) -> None:
    numbers = parameters(law, stiffness=1e10, exponent=exponent, restitution=restitution)
    for depth in (0.0, -1e-9, -1.0):
        assert law.normal_force(numbers, 1e10, depth, rate, impact_rate) == (0.0, 0.0)
        assert law.elastic_energy(numbers, 0.0, depth) == 0.0


@contact_law
@given(restitution=restitutions, exponent=exponents, impact_rate=impact_rates)
def test_the_contact_force_sets_in_continuously(
    law: ModuleType, restitution: float, exponent: float, impact_rate: float
) -> None:
    numbers = parameters(law, stiffness=1e10, exponent=exponent, restitution=restitution)
    for depth in (1e-6, 1e-9, 1e-12):
        force, _ = law.normal_force(numbers, 1e10, depth, impact_rate, impact_rate)
        # at onset the rate is the impact rate, so damping at most doubles the elastic force
        assert 0.0 <= force <= 2.0 * 1e10 * depth**exponent


@contact_law
@given(
    restitution=restitutions, exponent=exponents, depth=depths, rate=rates, impact_rate=impact_rates
)
def test_contact_never_pulls(
    law: ModuleType,
    restitution: float,
    exponent: float,
    depth: float,
    rate: float,
    impact_rate: float,
) -> None:
    numbers = parameters(law, stiffness=1e10, exponent=exponent, restitution=restitution)
    force, elastic = law.normal_force(numbers, 1e10, depth, rate, impact_rate)
    assert force >= 0.0
    assert elastic == pytest.approx(1e10 * depth**exponent, rel=ROUNDING)


def lost_in_a_cycle(law: ModuleType, restitution: float, exponent: float) -> float:
    """Area of the force loop over depth = 1 - cos t, as a share of the energy stored halfway."""
    numbers = parameters(law, stiffness=1.0, exponent=exponent, restitution=restitution)

    def power(t: float) -> float:
        depth, rate = 1.0 - math.cos(t), math.sin(t)
        return float(law.normal_force(numbers, 1.0, depth, rate, 1.0)[0]) * rate

    area = quad(power, 0.0, math.pi)[0] + quad(power, math.pi, 2.0 * math.pi)[0]
    elastic = law.normal_force(numbers, 1.0, 2.0, 0.0, 1.0)[1]
    return float(area / law.elastic_energy(numbers, elastic, 2.0))


@contact_law
@pytest.mark.parametrize("exponent", [1.2, 1.5, 2.0])
def test_contact_loses_energy_over_a_cycle_and_less_so_the_nearer_restitution_is_to_one(
    law: ModuleType, exponent: float
) -> None:
    losses = [lost_in_a_cycle(law, e, exponent) for e in (0.0, 0.3, 0.7, 0.9, 0.99, 0.999, 1.0)]
    assert all(loss >= -1e-12 for loss in losses)  # quadrature is exact to 1e-13
    assert losses == sorted(losses, reverse=True)
    assert losses[0] > 0.3
    assert losses[-2] < 0.01
    assert abs(losses[-1]) < 1e-12


@contact_law
@given(
    metre=st.floats(0.01, 100.0),
    kilogram=st.floats(0.01, 100.0),
    second=st.floats(0.01, 100.0),
    exponent=exponents,
    restitution=restitutions,
    depth=depths,
    rate=rates,
    impact_rate=impact_rates,
)
def test_contact_laws_are_dimensionally_homogeneous(
    law: ModuleType,
    metre: float,
    kilogram: float,
    second: float,
    exponent: float,
    restitution: float,
    depth: float,
    rate: float,
    impact_rate: float,
) -> None:
    newton, speed = kilogram * metre / second**2, metre / second
    numbers = parameters(law, stiffness=1e10, exponent=exponent, restitution=restitution)
    force, elastic = law.normal_force(numbers, 1e10, depth, rate, impact_rate)
    energy = law.elastic_energy(numbers, elastic, depth)
    rescaled, rescaled_elastic = law.normal_force(
        numbers,
        1e10 * newton / metre**exponent,
        depth * metre,
        rate * speed,
        impact_rate * speed,
    )
    # a force that is the small difference of elastic and damping parts keeps their rounding
    tiny = 1e3 * ROUNDING * elastic * newton * max(1.0, abs(rate) / impact_rate)
    assert rescaled == pytest.approx(force * newton, rel=ROUNDING, abs=tiny)
    assert law.elastic_energy(numbers, rescaled_elastic, depth * metre) == pytest.approx(
        energy * newton * metre, rel=1e3 * ROUNDING
    )


@contact_law
@given(
    metre=st.floats(0.01, 100.0),
    pascal=st.floats(0.01, 100.0),
    radius=st.floats(1e-3, 0.1),
    share=st.floats(1e-3, 0.9),
)
def test_the_stiffness_from_materials_is_dimensionally_homogeneous(
    law: ModuleType, metre: float, pascal: float, radius: float, share: float
) -> None:
    here = law.contact_stiffness(parameters(law), radius, share * radius)
    steel = parameters(law, youngs_modulus=2.07e11 * pascal)
    there = law.contact_stiffness(steel, radius * metre, share * radius * metre)
    # N/m^1.5 = Pa m^0.5; the difference of radii loses three digits at the smallest share
    assert there == pytest.approx(here * pascal * math.sqrt(metre), rel=1e3 * ROUNDING)


def test_equation_9_gives_the_stiffness_that_the_literature_prints() -> None:
    law = parameters(CONTACT_LAWS["lankarani-nikravesh"], youngs_modulus=2.07e11, poisson_ratio=0.3)
    assert contact_stiffness(law, 0.01, 5e-4) == pytest.approx(6.610e10, rel=2e-4)  # four digits
    assert contact_stiffness(law, 0.005, 5e-4) == pytest.approx(3.217e10, rel=2e-4)
    # the same for any pair: 4/3 E* sqrt(R), E* of two equal bodies, R from 1/R_j - 1/R_i
    effective = 2.07e11 / (1.0 - 0.3**2) / 2.0
    radius = 1.0 / (1.0 / 0.0095 - 1.0 / 0.01)
    assert contact_stiffness(law, 0.01, 5e-4) == pytest.approx(
        4.0 / 3.0 * effective * math.sqrt(radius), rel=1e-12
    )


def test_a_given_stiffness_takes_the_place_of_equation_9() -> None:
    law = parameters(CONTACT_LAWS["lankarani-nikravesh"], stiffness=5e9)
    assert contact_stiffness(law, 0.01, 5e-4) == 5e9


# friction

coefficients = st.floats(1e-3, 2.0)
normal_forces = st.one_of(st.just(0.0), st.floats(1e-9, 1e5))
slips = st.floats(-10.0, 10.0)


@friction_law
@given(coefficient=coefficients, normal=normal_forces, slip=slips)
def test_friction_opposes_slip_is_odd_and_bounded(
    law: ModuleType, coefficient: float, normal: float, slip: float
) -> None:
    numbers = parameters(law, coefficient=coefficient)
    force = law.friction_force(numbers, normal, slip)
    assert force * slip <= 0.0
    assert law.friction_force(numbers, normal, -slip) == -force
    assert abs(force) <= coefficient * normal
    assert law.friction_force(numbers, 0.0, slip) == 0.0
    assert law.friction_force(numbers, normal, 0.0) == 0.0


@friction_law
@given(coefficient=coefficients, normal=normal_forces, first=slips, second=slips)
def test_friction_grows_with_slip_up_to_the_full_force(
    law: ModuleType, coefficient: float, normal: float, first: float, second: float
) -> None:
    assume(abs(first) <= abs(second))
    numbers = parameters(law, coefficient=coefficient)
    forces = [abs(law.friction_force(numbers, normal, v)) for v in (first, second)]
    assert forces[0] <= forces[1]
    full = abs(law.friction_force(numbers, normal, numbers.dynamic_velocity * (1.0 + 1e-9)))
    assert full == pytest.approx(coefficient * normal, rel=ROUNDING)


@friction_law
@given(
    newton=st.floats(0.01, 100.0),
    speed=st.floats(0.01, 100.0),
    coefficient=coefficients,
    normal=normal_forces,
    slip=slips,
)
def test_friction_laws_are_dimensionally_homogeneous(
    law: ModuleType, newton: float, speed: float, coefficient: float, normal: float, slip: float
) -> None:
    limits = {"static_velocity": 0.1, "dynamic_velocity": 1.0}
    here = law.friction_force(parameters(law, coefficient=coefficient, **limits), normal, slip)
    scaled = {name: value * speed for name, value in limits.items()}
    there = law.friction_force(
        parameters(law, coefficient=coefficient, **scaled), normal * newton, slip * speed
    )
    # near the foot of the ramp the difference of velocities keeps the rounding of either
    tiny = 10.0 * ROUNDING * coefficient * normal * newton
    assert there == pytest.approx(here * newton, rel=ROUNDING, abs=tiny)


@friction_law
@given(limit=st.floats(1e-6, 1.0), normal=st.floats(1.0, 1e5))
def test_equal_limit_velocities_make_friction_a_step(
    law: ModuleType, limit: float, normal: float
) -> None:
    numbers = parameters(law, coefficient=0.5, static_velocity=limit, dynamic_velocity=limit)
    for slip in (0.0, 0.5 * limit, limit):
        assert law.friction_force(numbers, normal, slip) == 0.0
    for slip in (math.nextafter(limit, math.inf), 2.0 * limit):
        assert law.friction_force(numbers, normal, slip) == -0.5 * normal
        assert law.friction_force(numbers, normal, -slip) == 0.5 * normal


def test_modified_coulomb_ramps_between_its_limit_velocities() -> None:
    law = FRICTION_LAWS["modified-coulomb"]
    numbers = parameters(law, coefficient=0.1, static_velocity=1e-3, dynamic_velocity=1e-2)
    for slip, share in ((5e-4, 0.0), (1e-3, 0.0), (5.5e-3, 0.5), (1e-2, 1.0), (1.0, 1.0)):
        assert law.friction_force(numbers, 100.0, slip) == pytest.approx(
            -10.0 * share, rel=ROUNDING, abs=10.0 * ROUNDING
        )


# documentation


@pytest.mark.parametrize("law", [*CONTACT_LAWS.values(), *FRICTION_LAWS.values()])
def test_every_law_cites_its_source_and_says_where_it_fails(law: ModuleType) -> None:
    text = model_docstring(law)
    assert re.search(r"Source: .*\b(19|20)\d\d\b.*eqs? \d", text, re.DOTALL)
    assert "Assumes" in text
    assert "Fails" in text
    assert re.search(r"eqs? \(?\d", inspect.getsource(law))


@pytest.mark.parametrize("roster", [CONTACT_LAWS, FRICTION_LAWS], ids=["contact", "friction"])
def test_every_law_in_a_roster_is_the_law_it_is_listed_as(roster: dict[str, ModuleType]) -> None:
    for name, law in roster.items():
        needed = {"coefficient": 0.1} if roster is FRICTION_LAWS else {}
        assert parameters(law, **needed).law == name

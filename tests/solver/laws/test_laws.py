"""Every law in the registries: the specification of its family, and what it alone promises."""

import math
from typing import ClassVar

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.integrate import quad

from jointplay.solver.laws.contact import LAWS as CONTACT_LAWS
from jointplay.solver.laws.contact.adams_impact import AdamsImpact
from jointplay.solver.laws.contact.lankarani_nikravesh import LankaraniNikravesh
from jointplay.solver.laws.contact.long_bearing_film import LongBearingFilm
from jointplay.solver.laws.contact.short_bearing_film import ShortBearingFilm
from jointplay.solver.laws.contact.stiffness_and_dissipation import StiffnessAndDissipation
from jointplay.solver.laws.friction import LAWS as FRICTION_LAWS
from jointplay.solver.laws.friction.bengisu_akay import BengisuAkay
from jointplay.solver.laws.friction.brown_mcphee import BrownMcPhee
from jointplay.solver.laws.friction.dahl import Dahl
from jointplay.solver.laws.friction.lugre import LuGre
from jointplay.solver.laws.friction.modified_coulomb import ModifiedCoulomb
from jointplay.solver.laws.friction.stribeck import Stribeck
from jointplay.solver.laws.friction.threlfall import Threlfall
from tests.solver.laws.specification.contact import FIT, ContactSpecification, Fit
from tests.solver.laws.specification.friction import FrictionSpecification, normal_forces, slips
from tests.solver.laws.specification.units import ROUNDING

exponents = st.one_of(st.just(1.5), st.floats(1.0, 3.0))
restitutions = st.floats(0.0, 1.0)
coefficients = st.floats(1e-3, 2.0)


class TestLankaraniNikravesh(ContactSpecification):
    model = LankaraniNikravesh
    laws = st.one_of(
        st.builds(
            LankaraniNikravesh,
            stiffness=st.just(1e10),
            exponent=exponents,
            restitution=restitutions,
        ),
        st.builds(LankaraniNikravesh, restitution=restitutions),
    )


PAIRS = [
    ({"law": "power", "stiffness": 1e10}, {"law": "exact", "restitution": 0.5}),
    ({"law": "hertz-spheres"}, {"law": "tsuji", "restitution": 0.7, "effective_mass": 2.0}),
    ({"law": "johnson"}, {"law": "hu-guo", "restitution": 0.3}),
    ({"law": "liu"}, {"law": "jankowski", "restitution": 0.9, "effective_mass": 0.5}),
]


class TestStiffnessAndDissipation(ContactSpecification):
    """Promises that any two of the registries share with other contact laws, on some of them."""

    model = StiffnessAndDissipation
    laws = st.sampled_from(
        [
            StiffnessAndDissipation.model_validate({"stiffness": s, "dissipation": d})
            for s, d in PAIRS
        ]
    )


class TestShortBearingFilm(ContactSpecification):
    """Its dry contact, which alone depends on a depth; the oil is tried beside it."""

    model = ShortBearingFilm
    oil: ClassVar[dict[str, float]] = {"viscosity": 0.1, "boundary_layer": 1e-5}
    laws = st.just(
        ShortBearingFilm.model_validate(
            oil | {"stiffness": PAIRS[0][0], "dissipation": PAIRS[0][1]}
        )
    )


class TestLongBearingFilm(TestShortBearingFilm):
    """The same dry contact under oil that flows around the journal."""

    model = LongBearingFilm
    laws = st.just(
        LongBearingFilm.model_validate(
            TestShortBearingFilm.oil | {"stiffness": PAIRS[0][0], "dissipation": PAIRS[0][1]}
        )
    )


class TestAdamsImpact(ContactSpecification):
    model = AdamsImpact
    laws = st.builds(
        AdamsImpact,
        stiffness=st.just(1e10),
        exponent=exponents,
        damping=st.floats(0.0, 1e4),
        full_damping_depth=st.floats(1e-5, 1e-4),
    )


class TestModifiedCoulomb(FrictionSpecification):
    model = ModifiedCoulomb
    laws = st.builds(
        ModifiedCoulomb,
        coefficient=coefficients,
        static_velocity=st.just(0.1),
        dynamic_velocity=st.just(1.0),
    )


breakaway = {"static_coefficient": st.just(0.3), "kinetic_coefficient": st.floats(0.05, 0.3)}


class TestThrelfall(FrictionSpecification):
    model = Threlfall
    laws = st.builds(Threlfall, coefficient=coefficients, full_velocity=st.just(0.1))


class TestBengisuAkay(FrictionSpecification):
    model = BengisuAkay
    laws = st.builds(BengisuAkay, **breakaway, static_velocity=st.just(0.1))


class TestStribeck(FrictionSpecification):
    model = Stribeck
    laws = st.builds(Stribeck, **breakaway)


class TestBrownMcPhee(FrictionSpecification):
    model = BrownMcPhee
    laws = st.builds(BrownMcPhee, **breakaway)


class TestDahl(FrictionSpecification):
    model = Dahl
    laws = st.builds(Dahl, coefficient=st.floats(0.01, 1.0), bristle_stiffness=st.floats(1.0, 1e4))


class TestLuGre(FrictionSpecification):
    model = LuGre
    laws = st.builds(
        LuGre,
        **breakaway,
        bristle_stiffness=st.floats(1.0, 1e4),
        bristle_damping=st.floats(0.0, 0.1),
        viscous_damping=st.floats(0.0, 0.1),
    )


def test_every_law_in_a_registry_is_specified_and_is_the_law_it_is_listed_as() -> None:
    specified = {
        TestLankaraniNikravesh.model,
        TestStiffnessAndDissipation.model,
        TestAdamsImpact.model,
        TestShortBearingFilm.model,
        TestLongBearingFilm.model,
        TestModifiedCoulomb.model,
        TestThrelfall.model,
        TestBengisuAkay.model,
        TestStribeck.model,
        TestBrownMcPhee.model,
        TestDahl.model,
        TestLuGre.model,
    }
    assert {*CONTACT_LAWS.values(), *FRICTION_LAWS.values()} == specified
    for registry in (CONTACT_LAWS, FRICTION_LAWS):
        for name, law in registry.items():
            assert law.model_fields["law"].default == name


# contact


def lost_in_a_cycle(restitution: float, exponent: float) -> float:
    """Area of the force loop over depth = 1 - cos t, as a share of the energy stored halfway."""
    law = LankaraniNikravesh(stiffness=1.0, exponent=exponent, restitution=restitution)

    def power(t: float) -> float:
        depth, rate = 1.0 - math.cos(t), math.sin(t)
        return float(law.normal_force(FIT, depth, rate, 1.0)) * rate

    area = quad(power, 0.0, math.pi)[0] + quad(power, math.pi, 2.0 * math.pi)[0]
    return float(area / law.elastic_energy(FIT, 2.0))


@pytest.mark.parametrize("exponent", [1.2, 1.5, 2.0])
def test_contact_loses_less_over_a_cycle_the_nearer_restitution_is_to_one(exponent: float) -> None:
    losses = [lost_in_a_cycle(e, exponent) for e in (0.0, 0.3, 0.7, 0.9, 0.99, 0.999, 1.0)]
    assert all(loss >= -1e-12 for loss in losses)  # quadrature is exact to 1e-13
    assert losses == sorted(losses, reverse=True)
    assert losses[0] > 0.3
    assert losses[-2] < 0.01
    assert abs(losses[-1]) < 1e-12


def test_equation_9_gives_the_stiffness_that_the_literature_prints() -> None:
    law = LankaraniNikravesh(youngs_modulus=2.07e11, poisson_ratio=0.3)
    stiffness = law.contact_stiffness(Fit(0.01, 5e-4))
    assert stiffness == pytest.approx(6.610e10, rel=2e-4)  # four digits
    assert law.contact_stiffness(Fit(0.005, 5e-4)) == pytest.approx(3.217e10, rel=2e-4)
    # the same for any pair: 4/3 E* sqrt(R), E* of two equal bodies, R from 1/R_j - 1/R_i
    effective = 2.07e11 / (1.0 - 0.3**2) / 2.0
    radius = 1.0 / (1.0 / 0.0095 - 1.0 / 0.01)
    assert stiffness == pytest.approx(4.0 / 3.0 * effective * math.sqrt(radius), rel=1e-12)


def test_the_law_of_the_paper_is_a_pair_of_the_registries() -> None:
    damping = {"law": "lankarani-nikravesh", "restitution": 0.7}
    for given_one, stiffness in (
        ({}, {"law": "hertz-spheres"}),
        ({"stiffness": 5e9, "exponent": 1.2}, {"law": "power", "stiffness": 5e9, "exponent": 1.2}),
    ):
        whole = LankaraniNikravesh(restitution=0.7, **given_one)
        pair = StiffnessAndDissipation.model_validate(
            {"stiffness": stiffness, "dissipation": damping}
        )
        for rate in (-0.1, 0.0, 0.05):
            assert whole.normal_force(FIT, 1e-6, rate, 0.1) == pair.normal_force(
                FIT, 1e-6, rate, 0.1
            )


def test_a_given_stiffness_takes_the_place_of_equation_9() -> None:
    assert LankaraniNikravesh(stiffness=5e9).contact_stiffness(FIT) == 5e9


# friction


@given(coefficient=coefficients, normal=normal_forces, first=slips, second=slips)
def test_friction_opposes_slip_and_grows_with_it_up_to_the_full_force(
    coefficient: float, normal: float, first: float, second: float
) -> None:
    assume(abs(first) <= abs(second))
    law = ModifiedCoulomb(coefficient=coefficient)
    assert law.friction_force(normal, first) * first <= 0.0
    forces = [abs(law.friction_force(normal, v)) for v in (first, second)]
    assert forces[0] <= forces[1] <= coefficient * normal
    full = abs(law.friction_force(normal, law.full_slip_speed * (1.0 + 1e-9)))
    assert full == pytest.approx(coefficient * normal, rel=ROUNDING)


@given(limit=st.floats(1e-6, 1.0), normal=st.floats(1.0, 1e5))
def test_equal_limit_velocities_make_friction_a_step(limit: float, normal: float) -> None:
    law = ModifiedCoulomb(coefficient=0.5, static_velocity=limit, dynamic_velocity=limit)
    assert "dynamic_velocity" in law.tangent_obstacle
    for slip in (0.0, 0.5 * limit, limit):
        assert law.friction_force(normal, slip) == 0.0
    for slip in (math.nextafter(limit, math.inf), 2.0 * limit):
        assert law.friction_force(normal, slip) == -0.5 * normal
        assert law.friction_force(normal, -slip) == 0.5 * normal


def test_modified_coulomb_ramps_between_its_limit_velocities() -> None:
    law = ModifiedCoulomb(coefficient=0.1, static_velocity=1e-3, dynamic_velocity=1e-2)
    for slip, share in ((5e-4, 0.0), (1e-3, 0.0), (5.5e-3, 0.5), (1e-2, 1.0), (1.0, 1.0)):
        assert law.friction_force(100.0, slip) == pytest.approx(
            -10.0 * share, rel=ROUNDING, abs=10.0 * ROUNDING
        )


@pytest.mark.parametrize("coefficient", [0.0, 0.1])
def test_friction_without_a_coefficient_is_off(coefficient: float) -> None:
    assert ModifiedCoulomb(coefficient=coefficient).is_off == (coefficient == 0.0)

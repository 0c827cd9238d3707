"""Every stiffness law: what all of them must do, and the numbers of line contact."""

import inspect
import math
import warnings

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.optimize import brentq

from jointplay.records.failure import InvalidInput
from jointplay.solver.kernels.trace.tracer import Tracer
from jointplay.solver.kinds import admit
from jointplay.solver.laws.stiffness import LAWS, Stiffness
from jointplay.solver.laws.stiffness.logarithmic import LAST_T, Logarithmic, lower_branch
from jointplay.solver.laws.stiffness.pereira import Pereira
from jointplay.solver.scene.sizes import ill_sized
from tests.solver.kernels.test_tracer import evaluate
from tests.solver.laws.specification.contact import FIT, Fit
from tests.solver.laws.specification.member import documented
from tests.solver.laws.specification.units import Units, rescaled, some_units
from tests.solver.laws.thrown import pair, thrown

STEEL = {"youngs_modulus": 2.07e11, "poisson_ratio": 0.3}
MEMBERS: list[Stiffness] = [
    law.model_validate({"stiffness": 1e10} if name == "power" else STEEL)
    for name, law in LAWS.items()
]
MEMBERS.append(LAWS["power"].model_validate({"stiffness": 1e9, "exponent": 1.2}))
OF_THEIR_UNITS = {"goldsmith", "pereira"}
"""Laws that are published as numbers in certain units."""
fits = st.builds(Fit, st.floats(5e-3, 5e-2), st.floats(1e-5, 1e-3), st.floats(5e-3, 5e-2))
shares = st.floats(1e-6, 0.2)
each = pytest.mark.parametrize("law", MEMBERS, ids=lambda law: law.law)


@each
def test_it_cites_its_source_and_says_where_it_fails(law: Stiffness) -> None:
    documented(type(law))
    assert type(law).model_fields["law"].default == law.law


@each
@given(fit=fits, share=shares)
def test_force_energy_and_slope_belong_together(law: Stiffness, fit: Fit, share: float) -> None:
    depth = share * fit.radial_clearance
    for apart in (0.0, -depth):
        assert law.force(fit, apart) == law.energy(fit, apart) == law.slope(fit, apart) == 0.0
    work = quad(lambda x: law.force(fit, x), 0.0, depth, epsabs=0.0)[0]
    # of the quadrature, where forces set in as a broken power; the readme of Liu's says 1e-11
    assert law.energy(fit, depth) == pytest.approx(work, rel=1e-7)
    step = 1e-5 * depth
    ends = [law.force(fit, depth + side * step) for side in (-1.0, 1.0)]
    assert 0.0 < ends[0] < law.force(fit, depth) < ends[1]
    # a central difference errs by its square, or of first order where the tangent takes over
    assert (ends[1] - ends[0]) / (2.0 * step) == pytest.approx(law.slope(fit, depth), rel=2e-5)
    assert law.force(fit, 1e-20 * depth) < 1e-19 * law.force(fit, depth)


@each
@given(units=some_units, share=shares)
def test_it_is_dimensionally_homogeneous(law: Stiffness, units: Units, share: float) -> None:
    if law.law in OF_THEIR_UNITS:
        assert " metres " in (text := inspect.getdoc(type(law)) or "") or "in mm" in text
        return
    there, fit = rescaled(law, units), Fit(*(units.m * length for length in FIT))
    depth, newton = share * FIT.radial_clearance, units.of("N", law)
    for found, expected in (
        (there.force(fit, depth * units.m), law.force(FIT, depth) * newton),
        (there.energy(fit, depth * units.m), law.energy(FIT, depth) * newton * units.m),
        (there.slope(fit, depth * units.m), law.slope(FIT, depth) * newton / units.m),
    ):
        assert found == pytest.approx(expected, rel=1e-9)  # of b / F with large exponents


@each
def test_it_is_traced_as_it_is_written(law: Stiffness) -> None:
    tracer = Tracer()
    numbers = {
        name: tracer.number(name, value)
        for name, value in law.model_dump().items()
        if isinstance(value, float) and not (name == "exponent" and value == 1.5)
    }
    seen = type(law).model_construct(**{**law.model_dump(), **numbers})
    fit = Fit(*(tracer.number(f"fit{i}", length) for i, length in enumerate(FIT)))
    depth = tracer.variable("depth")
    for name in ("force", "energy", "slope"):
        node = tracer.lift(getattr(seen, name)(fit, depth))
        for share in (-1e-3, 0.0, 1e-9, 1e-4, 0.03, 0.7, 2.0):
            here = share * FIT.radial_clearance
            found = evaluate(node, {**tracer.numbers, "depth": here}, {})
            # logarithms and exponentials of our own, to 4e-16 of numbers up to 700
            assert found == pytest.approx(getattr(law, name)(FIT, here), rel=1e-12), (name, share)


def test_at_a_micrometre_laws_of_lines_agree_within_what_is_known_of_them() -> None:
    forces = {law.law: law.force(Fit(5e-3, 5e-4, 0.01), 1e-6) for law in MEMBERS}
    expected = {
        "hertz-spheres": 32.17,
        "liu": 56.44,
        "goldsmith": 170.5,
        "dubowsky-freudenstein": 321.5,
        "esdu-78035": 324.9,
        "radzimovsky": 393.4,
        "johnson": 407.3,
        "pereira": 428.4,
    }
    # to the four figures of an independent program that inverts each formula by bisection
    assert {name: forces[name] for name in expected} == pytest.approx(expected, rel=2e-4)


PUBLISHED = {
    "johnson": lambda f, h, e: f / (math.pi * e) * (math.log(4 * math.pi * e * FIT[1] / f) - 1),
    "esdu-78035": lambda f, h, e: f * h * (math.log(4 * FIT[1] / (f * h)) + 1),
    "goldsmith": lambda f, h, e: f * h * (math.log(FIT[1] / (f * RADII * h)) + 1),
    "dubowsky-freudenstein": lambda f, h, e: (
        f * h * (math.log(FIT[2] ** 2 * FIT[1] / (f * RADII * h)) + 1)
    ),
    "radzimovsky": lambda f, h, e: (
        f
        / (math.pi * e)
        * (2 / 3 + sum(math.log(4 * r / width(f, e)) for r in (FIT[0], FIT[0] - FIT[1])))
    ),
}
"""δ (m) of a load per width (N/m), h_i + h_j and E*, as the sources print it."""
RADII = FIT[0] * (FIT[0] - FIT[1])


def width(line_load: float, modulus: float) -> float:
    return 1.6 * math.sqrt(line_load * 2.0 * RADII / FIT[1] / modulus)


@pytest.mark.parametrize("name", PUBLISHED)
@given(depth=st.floats(1e-9, 5e-5))
def test_logarithms_are_inverted_as_printed(name: str, depth: float) -> None:
    modulus = 2.07e11 / (1.0 - 0.3**2) / 2.0
    both = 1.0 / (math.pi * modulus)

    def surplus(log_load: float) -> float:
        return float(PUBLISHED[name](math.exp(log_load), both, modulus)) - depth

    load = math.exp(brentq(surplus, 0.0, math.log(1e7), xtol=1e-14))
    law = LAWS[name].model_validate(STEEL)
    assert law.force(FIT, depth) == pytest.approx(load * FIT.bearing_width, rel=1e-11)


def test_newtons_rule_reaches_rounding_in_three_rounds() -> None:
    for t in np.geomspace(LAST_T, 700.0, 500):
        u = lower_branch(float(t))
        assert u - math.log(u) == pytest.approx(t, rel=4e-16)
        assert u >= 2.0 - 1e-15


@pytest.mark.parametrize("law", [x for x in MEMBERS if isinstance(x, Logarithmic)], ids=str)
def test_beyond_its_logarithm_the_force_goes_on_along_the_tangent(law: Logarithmic) -> None:
    deepest = law.deepest(FIT)
    slope = law.slope(FIT, deepest)
    for beyond in (1e-9, 0.1, 1.0, 1e3):
        depth = deepest * (1.0 + beyond)
        assert law.slope(FIT, depth) == pytest.approx(slope, rel=1e-12)
        assert law.force(FIT, depth) == pytest.approx(
            law.force(FIT, deepest) + slope * (depth - deepest), rel=1e-12
        )
    assert slope == pytest.approx(law.slope(FIT, deepest * (1.0 - 1e-9)), rel=1e-8)


def refused(scene: dict[str, object]) -> list[tuple[str, str]]:
    with pytest.raises(InvalidInput) as found:
        admit({"kind": "simulate", "scene": scene, "duration": 1e-3})
    return [(problem.pointer, problem.detail) for problem in found.value.problems]


def test_a_line_needs_the_bearings_width() -> None:
    scene = thrown(pair({"law": "johnson"}, {"law": "none"}))
    place = "/scene/joints/bearing0/clearance"
    del scene["joints"]["bearing0"]["clearance"]["bearing_width"]
    ((pointer, words),) = refused(scene)
    assert pointer == f"{place}/bearing_width"
    assert "'johnson' needs the bearing's width; give a bearing_width in m" in words


def test_pereiras_law_is_refused_outside_of_its_clearances() -> None:
    scene = thrown(pair({"law": "pereira"}, {"law": "none"}))
    scene["joints"]["bearing0"]["clearance"]["radial_clearance"] = 1e-6
    ((pointer, words),) = refused(scene)
    assert pointer == "/scene/joints/bearing0/clearance/radial_clearance"
    assert "from 5e-06 to 0.01 m, not for 1e-06 m" in words
    law, clearance = Pereira.model_validate(STEEL), 0.34954e-3
    # where the exponent's formula changes, both give 1.15 but for what the source rounds
    ends = [law.exponent_for(Fit(0.01, clearance * (1.0 + side))) for side in (-1e-9, 1e-9)]
    assert ends[0] == pytest.approx(ends[1], rel=2e-3)


def test_a_start_beyond_the_logarithm_is_refused_for_one_scene_and_for_columns() -> None:
    scene = thrown(pair({"law": "johnson"}, {"law": "none"}))
    place = "/start/joints/bearing0/eccentricity/0"
    scene["start"] = {"joints": {"bearing0": {"eccentricity": [6.9e-4, 0.0]}}}
    assert admit({"kind": "simulate", "scene": scene, "duration": 1e-3}).scene.start.joints
    scene["start"]["joints"]["bearing0"]["eccentricity"] = [8e-4, 0.0]
    ((pointer, words),) = refused(scene)
    assert pointer == f"/scene{place}"
    assert "deeper in its bearing than 0.000199 m, where the logarithm of" in words
    scene["start"]["joints"]["bearing0"]["eccentricity"] = [6.9e-4, 0.0]
    admitted = admit({"kind": "simulate", "scene": scene, "duration": 1e-3}).scene
    column = {place: np.array([6.9e-4, 8e-4])}
    assert ill_sized(admitted, column, 2).tolist() == [False, True]
    width = {"/joints/bearing0/clearance/bearing_width": np.array([0.015, 0.0])}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert not ill_sized(admitted, width, 2)[0]

"""Oil in bearings: quadrature of the pressure, energy, momentum, a falling journal."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from jointplay.records.failure import InvalidInput
from jointplay.solver.kernels.trace.tracer import Tracer
from jointplay.solver.kinds import admit
from jointplay.solver.laws.contact.film import Film
from jointplay.solver.laws.contact.long_bearing_film import LongBearingFilm
from jointplay.solver.laws.contact.oil_film import OilFilm
from jointplay.solver.laws.contact.short_bearing_film import ShortBearingFilm
from jointplay.solver.quantities.scalars import direction_angle
from tests.solver.completed_runs import run
from tests.solver.kernels.test_tracer import evaluate
from tests.solver.laws.specification.contact import FIT

DRY = {
    "stiffness": {"law": "hertz-spheres"},
    "dissipation": {"law": "exact", "restitution": 0.8},
}
OIL: dict[str, Any] = {"viscosity": 0.4, "boundary_layer": 1e-5} | DRY
LAW, LONG = ShortBearingFilm.model_validate(OIL), LongBearingFilm.model_validate(OIL)
LAWS = pytest.mark.parametrize("law", [LAW, LONG], ids=lambda law: law.law)
speeds, spins = st.floats(-1.0, 1.0), st.floats(-300.0, 300.0)
NODES, WEIGHTS = np.polynomial.legendre.leggauss(200)
some = settings(max_examples=30, database=None)


def at(
    law: OilFilm,
    share: float,
    angle: float,
    rate: tuple[float, float],
    turn: tuple[float, float],
) -> Film:
    """Return the film at a share of the radial clearance in a direction."""
    reach = share * FIT.radial_clearance
    return law.film(FIT, (reach * math.cos(angle), reach * math.sin(angle)), rate, turn)


def turn_integral(values: Any) -> Any:
    """Return the integral from -1 to each node of the polynomial through values at the nodes."""
    legendre = np.polynomial.legendre
    orders = np.arange(len(NODES))
    parts = (orders + 0.5) * ((WEIGHTS * values) @ legendre.legvander(NODES, len(NODES) - 1))
    return legendre.legval(NODES, legendre.legint(parts, lbnd=-1.0))


def short_pressure(growth: Any, thick: Any) -> Any:
    """Return a parabola over the width, integrated, N/m."""
    return np.maximum(0.0, -LAW.viscosity * FIT.bearing_width**3 * growth / thick**3)


def long_pressure(growth: Any, thick: Any) -> Any:
    """Return the pressure times the width, N/m, from Reynolds's equation integrated numerically."""
    step = 0.5 * math.pi
    flow, dragged = turn_integral(growth) * step, 12.0 * LAW.viscosity * FIT.bearing_radius**2
    ends = WEIGHTS @ (flow / thick**3) / (WEIGHTS @ thick**-3.0)
    return FIT.bearing_width * dragged * turn_integral((flow - ends) / thick**3) * step


PRESSURES = {"short-bearing-film": short_pressure, "long-bearing-film": long_pressure}


@LAWS
@some
@given(st.floats(0.0, 0.97), st.floats(-3.0, 3.0), speeds, speeds, spins, spins)
def test_it_is_the_integral_of_the_positive_pressure(
    law: OilFilm, share: float, angle: float, vx: float, vy: float, bearing: float, journal: float
) -> None:
    ex, ey = (share * FIT.radial_clearance * f(angle) for f in (math.cos, math.sin))
    mean = 0.5 * (bearing + journal)

    # the half in which the film is squeezed; its ends are zeros of the pressure
    tip = math.atan2(vy - mean * ex, vx + mean * ey)
    turn = tip + 0.5 * math.pi * NODES
    c, s = np.cos(turn), np.sin(turn)
    growth = mean * (ex * s - ey * c) - vx * c - vy * s
    thick = FIT.radial_clearance - ex * c - ey * s
    pressure = PRESSURES[law.law](growth, thick)
    weights = 0.5 * math.pi * WEIGHTS * FIT.bearing_radius
    size = np.abs(pressure) @ weights
    found = at(law, share, angle, (vx, vy), (bearing, journal)).force
    for force, part in zip(found, (c, s), strict=True):
        expected = -(pressure * part) @ weights
        assert force == pytest.approx(expected, rel=1e-9, abs=1e-9 * size + 1e-100)


@LAWS
@some
@given(st.floats(0.0, 1.2), st.floats(-3.0, 3.0), speeds, speeds, spins, spins)
def test_it_never_gives_energy_and_keeps_momentum(
    law: OilFilm, share: float, angle: float, vx: float, vy: float, bearing: float, journal: float
) -> None:
    film = at(law, share, angle, (vx, vy), (bearing, journal))
    (fx, fy), reach = film.force, share * FIT.radial_clearance
    ex, ey = reach * math.cos(angle), reach * math.sin(angle)
    put_in = -(fx * vx + fy * vy)
    put_in -= film.moment_on_journal * journal + film.moment_on_bearing * bearing
    size = abs(fx * vx) + abs(fy * vy) + math.hypot(fx, fy) * reach * 300.0 + film.loss
    assert put_in == pytest.approx(film.loss, abs=1e-12 * size)
    assert film.loss >= 0.0
    moments = film.moment_on_journal + film.moment_on_bearing + ex * fy - ey * fx
    size = math.hypot(fx, fy) * reach + abs(film.moment_on_journal)
    assert moments == pytest.approx(0.0, abs=1e-12 * size)


def test_a_steadily_turning_journal_has_the_load_and_attitude_of_ocvirk() -> None:
    """Sommerfeld's number of a short bearing, and tan = π sqrt(1 - ε²) / (4 ε)."""
    share, spin = 0.6, 200.0
    fx, fy = at(LAW, share, 0.0, (0.0, 0.0), (0.0, spin)).force
    square = share * share
    width, radius, clearance = FIT.bearing_width, FIT.bearing_radius, FIT.radial_clearance
    scale = LAW.viscosity * spin * radius * width**3 / (4.0 * clearance**2)
    load = scale * share / (1.0 - square) ** 2
    expected = load * math.sqrt(16.0 * square + math.pi**2 * (1.0 - square))
    assert math.hypot(fx, fy) == pytest.approx(expected, rel=1e-12)
    attitude = math.pi * math.sqrt(1.0 - square) / (4.0 * share)
    assert abs(fy / fx) == pytest.approx(attitude, rel=1e-12)


def test_in_a_long_bearing_it_has_those_of_sommerfeld() -> None:
    """Half film: 6 ε sqrt(4 ε² + π² (1 - ε²)) / ((2 + ε²) (1 - ε²)); tan = π sqrt(1 - ε²) / 2 ε."""
    share, spin = 0.6, 200.0
    fx, fy = at(LONG, share, 0.0, (0.0, 0.0), (0.0, spin)).force
    square = share * share
    width, radius, clearance = FIT.bearing_width, FIT.bearing_radius, FIT.radial_clearance
    scale = LONG.viscosity * spin * radius**3 * width / clearance**2
    load = scale * 6.0 * share / ((2.0 + square) * (1.0 - square))
    expected = load * math.sqrt(4.0 * square + math.pi**2 * (1.0 - square))
    assert math.hypot(fx, fy) == pytest.approx(expected, rel=1e-12)
    attitude = math.pi * math.sqrt(1.0 - square) / (2.0 * share)
    assert abs(fy / fx) == pytest.approx(attitude, rel=1e-12)


@some
@given(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3))
def test_a_traced_angle_of_a_direction_is_the_librarys(x: float, y: float) -> None:
    assume(math.hypot(x, y) > 1e-9)
    tracer = Tracer()
    traced = direction_angle(tracer.variable("x"), tracer.variable("y"))
    found = evaluate(traced, {"x": x, "y": y}, {})
    apart = math.remainder(found - math.atan2(y, x), 2.0 * math.pi)
    assert apart == pytest.approx(0.0, abs=1e-15 * math.pi)


def bearing(
    viscosity: float, friction: dict[str, Any] | None = None, name: str = LAW.law
) -> dict[str, Any]:
    """Return a journal in oil that falls onto its bearing."""
    law = {"law": name} | OIL | {"viscosity": viscosity}
    clearance = FIT._asdict() | {"contact": law} | ({"friction": friction} if friction else {})
    return {
        "name": "bearing",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"shaft": {"mass": 2.0, "inertia": 1e-4, "points": {"O": [0.0, 0.0]}}},
        "joints": {
            "O": {
                "type": "revolute",
                "bearing": "ground.O",
                "journal": "shaft.O",
                "clearance": clearance,
            }
        },
        "start": {"angular_velocities": {"shaft": 300.0}, "velocities": {"shaft": [0.0, 0.0]}},
    }


@pytest.mark.parametrize(
    "law", [LAW, pytest.param(LONG, marks=pytest.mark.long)], ids=lambda law: law.law
)
def test_a_journal_whirls_in_its_oil_as_newton_says_and_the_ledger_closes(law: OilFilm) -> None:
    found = run(bearing(0.4, name=law.law), 0.02, tolerance=1e-9)

    def slopes(_t: float, state: Any) -> list[float]:
        x, y, _, vx, vy, spin = state
        film = law.film(FIT, (x, y), (vx, vy), (0.0, spin))
        (fx, fy), moment = film.force, film.moment_on_journal
        return [vx, vy, spin, fx / 2.0, fy / 2.0 - 9.81, moment / 1e-4]

    start = [0.0, 0.0, 0.0, 0.0, 0.0, 300.0]
    truth = solve_ivp(slopes, (0.0, 0.02), start, method="Radau", rtol=1e-10, atol=1e-14)
    reached = found.last("shaft.x", "shaft.y", "shaft.theta", "shaft.vx", "shaft.vy", "shaft.omega")
    np.testing.assert_allclose(reached, truth.y[:, -1], rtol=1e-6, atol=1e-10)
    assert found.peaks["O.penetration"].maximum < 0.0  # the oil bears it all
    ledger = found.statistics["energy"]
    assert abs(ledger["residual"]) <= 10.0 * 1e-9 * ledger["gross_work"]


@pytest.mark.long
def test_thin_oil_is_pressed_through_and_the_dry_contact_bears() -> None:
    found = run(bearing(1e-5, {"coefficient": 0.1}), 0.1)
    ledger = found.statistics["energy"]
    assert len(found.contacts("O")) > 0
    assert abs(ledger["residual"]) <= 10.0 * 1e-6 * ledger["gross_work"]


def test_a_layer_as_thick_as_the_clearance_and_a_missing_width_are_refused() -> None:
    scene = bearing(0.4)
    clearance = scene["joints"]["O"]["clearance"]
    clearance["contact"]["boundary_layer"] = 1e-3
    clearance["bearing_width"] = None
    with pytest.raises(InvalidInput) as refused:
        admit({"kind": "simulate", "scene": scene, "duration": 0.1})
    found = {problem.pointer: problem.detail for problem in refused.value.problems}
    place = "/scene/joints/O/clearance"
    assert "needs the bearing's width" in found[f"{place}/bearing_width"]
    assert "0.001 m leaves no film in a radial clearance of 0.0005 m" in found[f"{place}/contact"]

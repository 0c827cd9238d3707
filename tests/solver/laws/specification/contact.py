"""Demands on every contact law, whichever it is."""

import math
from typing import ClassVar, NamedTuple

import pytest
from hypothesis import strategies as st
from scipy.integrate import quad

from jointplay.solver.laws.contact import ContactLaw
from tests.solver.laws.specification.member import documented, for_any, rates
from tests.solver.laws.specification.units import ROUNDING, Units, rescaled, some_units


class Fit(NamedTuple):
    bearing_radius: float = 0.01
    radial_clearance: float = 5e-4
    bearing_width: float = 0.015


depths = st.floats(1e-9, 1e-3)
impact_rates = st.floats(1e-3, 2.0)
FIT = Fit()


class ContactSpecification:
    """Subclass it with the model and a strategy that draws laws of it."""

    model: ClassVar[type[ContactLaw]]
    laws: ClassVar[st.SearchStrategy[ContactLaw]]

    def test_it_cites_its_source_and_says_where_it_fails(self) -> None:
        documented(self.model)

    @for_any(rate=rates, impact_rate=impact_rates)
    def test_there_is_no_force_at_zero_depth(
        self, data: st.DataObject, rate: float, impact_rate: float
    ) -> None:
        law = data.draw(self.laws)
        for depth in (0.0, -1e-9, -1.0):
            assert law.normal_force(FIT, depth, rate, impact_rate) == 0.0
            assert law.elastic_energy(FIT, depth) == 0.0

    @for_any(impact_rate=impact_rates)
    def test_the_force_sets_in_continuously(self, data: st.DataObject, impact_rate: float) -> None:
        law = data.draw(self.laws)
        forces = [
            law.normal_force(FIT, depth, impact_rate, impact_rate) for depth in (1e-6, 1e-18, 1e-30)
        ]
        # a force that grows at least as the fourth root of the depth falls a thousandfold each time
        assert forces[1] <= 1.001e-3 * forces[0]
        assert forces[2] <= 1.001e-3 * forces[1]

    @for_any(depth=depths, rate=rates, impact_rate=impact_rates)
    def test_contact_never_pulls(
        self, data: st.DataObject, depth: float, rate: float, impact_rate: float
    ) -> None:
        assert data.draw(self.laws).normal_force(FIT, depth, rate, impact_rate) >= 0.0

    @for_any(deepest=depths, impact_rate=impact_rates)
    def test_a_cycle_of_depth_gives_no_energy_back_that_was_not_put_in(
        self, data: st.DataObject, deepest: float, impact_rate: float
    ) -> None:
        law = data.draw(self.laws)

        def power(turn: float) -> float:
            depth, rate = 0.5 * deepest * (1.0 - math.cos(turn)), impact_rate * math.sin(turn)
            return float(law.normal_force(FIT, depth, rate, impact_rate)) * math.sin(turn)

        work = [quad(power, side * math.pi, (side + 1) * math.pi)[0] for side in (0, 1)]
        # quadrature is exact to 1e-8 of either half, or better
        assert sum(work) >= -1e-7 * max(map(abs, work))

    @for_any(depth=depths)
    def test_the_elastic_energy_is_the_work_against_the_force_at_rest(
        self, data: st.DataObject, depth: float
    ) -> None:
        law = data.draw(self.laws)
        work = quad(lambda x: law.normal_force(FIT, x, 0.0, 1.0), 0.0, depth, epsabs=0.0)[0]
        assert law.elastic_energy(FIT, depth) == pytest.approx(work, rel=1e-7)
        step = 1e-5 * depth  # of a central difference: its error is about its square
        ends = [law.elastic_energy(FIT, depth + side * step) for side in (-1.0, 1.0)]
        assert (ends[1] - ends[0]) / (2.0 * step) == pytest.approx(
            law.normal_force(FIT, depth, 0.0, 1.0), rel=1e-8
        )

    @for_any(units=some_units, depth=depths, rate=rates, impact_rate=impact_rates)
    def test_it_is_dimensionally_homogeneous(
        self,
        data: st.DataObject,
        units: Units,
        depth: float,
        rate: float,
        impact_rate: float,
    ) -> None:
        here = data.draw(self.laws)
        there, newton, speed = rescaled(here, units), units.of("N", here), units.of("m/s", here)
        fit = Fit(*(units.m * length for length in FIT))
        force = here.normal_force(FIT, depth, rate, impact_rate)
        scaled = there.normal_force(fit, depth * units.m, rate * speed, impact_rate * speed)
        # a force that is the small difference of elastic and damping parts keeps their rounding
        most = max(force, here.normal_force(FIT, depth, 0.0, impact_rate))
        tiny = 1e3 * ROUNDING * most * newton * max(1.0, abs(rate) / impact_rate)
        assert scaled == pytest.approx(force * newton, rel=1e3 * ROUNDING, abs=tiny)
        assert there.elastic_energy(fit, depth * units.m) == pytest.approx(
            here.elastic_energy(FIT, depth) * newton * units.m, rel=1e3 * ROUNDING
        )

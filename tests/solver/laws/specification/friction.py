"""Demands on every friction law, whichever it is."""

import math
from collections.abc import Sequence
from typing import ClassVar

import numpy as np
import pytest
from hypothesis import strategies as st

from jointplay.solver.laws.friction import FrictionLaw
from tests.solver.laws.specification.member import documented, for_any
from tests.solver.laws.specification.units import ROUNDING, Units, rescaled, some_units

normal_forces = st.one_of(st.just(0.0), st.floats(1e-9, 1e5))
slips = st.floats(-10.0, 10.0)


class FrictionSpecification:
    """Subclass it with the model and a strategy that draws laws of it."""

    model: ClassVar[type[FrictionLaw]]
    laws: ClassVar[st.SearchStrategy[FrictionLaw]]

    def drawn(self, data: st.DataObject) -> tuple[FrictionLaw, list[float]]:
        """Return a law, and its inner states somewhere within their scales."""
        law = data.draw(self.laws)
        return law, [data.draw(st.floats(-1.0, 1.0)) * x.scale for x in law.inner_states]

    def test_it_cites_its_source_and_says_where_it_fails(self) -> None:
        documented(self.model)

    @for_any(slip=slips)
    def test_there_is_no_friction_without_a_normal_force(
        self, data: st.DataObject, slip: float
    ) -> None:
        law, inner = self.drawn(data)
        assert law.friction_force(0.0, slip, inner) == 0.0

    @for_any(normal=normal_forces)
    def test_there_is_no_friction_where_a_run_starts_at_rest(
        self, data: st.DataObject, normal: float
    ) -> None:
        law = data.draw(self.laws)
        start = [state.start for state in law.inner_states]
        assert law.friction_force(normal, 0.0, start) == 0.0

    @for_any(normal=normal_forces, slip=slips)
    def test_it_is_the_same_in_both_directions(
        self, data: st.DataObject, normal: float, slip: float
    ) -> None:
        law, inner = self.drawn(data)
        mirrored = [-x for x in inner]
        force = law.friction_force(normal, slip, inner)
        assert law.friction_force(normal, -slip, mirrored) == -force
        there = law.inner_rates(normal, -slip, mirrored)
        assert list(there) == [-rate for rate in law.inner_rates(normal, slip, inner)]

    @for_any(slip=slips)
    def test_rates_of_inner_states_do_not_jump_where_a_contact_begins(
        self, data: st.DataObject, slip: float
    ) -> None:
        law, inner = self.drawn(data)
        apart, touching = (law.inner_rates(normal, slip, inner) for normal in (0.0, 1e-9))
        np.testing.assert_allclose(touching, apart, rtol=1e-6)
        assert len(apart) == len(law.inner_states)

    @for_any(normal=st.floats(1.0, 1e5), speed=st.floats(1e-4, 10.0))
    def test_it_loses_energy_once_slip_comes_and_goes(
        self, data: st.DataObject, normal: float, speed: float
    ) -> None:
        law = data.draw(self.laws)
        inner = np.array([state.start for state in law.inner_states])
        if not len(inner):
            slips = speed * np.sin(2.0 * math.pi * (np.arange(400) + 0.5) / 400)
            assert -sum(law.friction_force(normal, slips, ()) * slips) >= 0.0
            return
        # slip comes and goes over several times what bends inner states
        stroke = max(10.0 * state.scale for state in law.inner_states)
        count = 400
        step = 2.0 * math.pi * stroke / speed / count
        lost = 0.0
        for i in range(3 * count):  # the first two cycles forget the start
            slip = speed * math.sin(2.0 * math.pi * (i + 0.5) / count)
            if i >= 2 * count:
                lost -= law.friction_force(normal, slip, list(inner)) * slip * step
            half = inner + 0.5 * step * np.array(law.inner_rates(normal, slip, list(inner)))
            inner = inner + step * np.array(law.inner_rates(normal, slip, list(half)))
        assert lost >= 0.0

    @for_any(units=some_units, normal=normal_forces, slip=slips)
    def test_it_is_dimensionally_homogeneous(
        self, data: st.DataObject, units: Units, normal: float, slip: float
    ) -> None:
        here, inner = self.drawn(data)
        there, newton, speed = rescaled(here, units), units.of("N", here), units.of("m/s", here)
        factors = [units.of(state.unit, here) for state in here.inner_states]
        assert [x.scale for x in there.inner_states] == pytest.approx(
            [x.scale * factor for x, factor in zip(here.inner_states, factors, strict=True)]
        )
        moved = [x * factor for x, factor in zip(inner, factors, strict=True)]
        # the difference of near velocities, or of the ends of a bristle, keeps their rounding
        tiny = 1e3 * ROUNDING * normal * newton
        assert there.friction_force(normal * newton, slip * speed, moved) == pytest.approx(
            here.friction_force(normal, slip, inner) * newton, rel=1e3 * ROUNDING, abs=tiny
        )
        rates = here.inner_rates(normal, slip, inner)
        found = there.inner_rates(normal * newton, slip * speed, moved)
        expected: Sequence[float] = [
            rate * factor / units.s for rate, factor in zip(rates, factors, strict=True)
        ]
        least = 1e3 * ROUNDING * abs(slip) * speed
        np.testing.assert_allclose(found, expected, rtol=1e3 * ROUNDING, atol=least)

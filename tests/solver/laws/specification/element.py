"""Demands on every force element, whichever it is."""

import math
from typing import ClassVar

import pytest
from hypothesis import assume
from hypothesis import strategies as st
from scipy.integrate import quad

from jointplay.solver.laws.force import Effect, Ends, ForceElement
from tests.solver.laws.specification.member import documented, for_any, rates
from tests.solver.laws.specification.units import Units, rescaled, some_units

lengths = st.floats(-1.0, 1.0)


class ElementSpecification:
    """Subclass it with the model and a strategy that draws elements of it."""

    model: ClassVar[type[ForceElement]]
    elements: ClassVar[st.SearchStrategy[ForceElement]]

    def test_it_cites_its_source_and_says_where_it_fails(self) -> None:
        documented(self.model)

    @for_any(x=lengths, y=lengths, vx=rates, vy=rates)
    def test_what_goes_in_is_stored_or_lost(
        self, data: st.DataObject, x: float, y: float, vx: float, vy: float
    ) -> None:
        assume(math.hypot(x, y) > 0.1)
        element, spins, span = data.draw(self.elements), (0.3, -0.7), 0.01

        def at(t: float) -> Effect:
            angles = spins[0] * t, 0.4 + spins[1] * t
            one, two = ((math.cos(angle), math.sin(angle)) for angle in angles)
            gap = x + t * vx, y + t * vy
            return element.effect(Ends(gap, (vx, vy), spins, (one, two), angles))

        def into_store(t: float) -> float:
            found = at(t)
            moved = found.force[0] * vx + found.force[1] * vy
            turned = found.moment * (spins[1] - spins[0]) + found.couple * spins[0]
            return float(-moved - turned - found.loss)

        gain, size = quad(into_store, 0.0, span)[0], at(0.0).stored + at(span).stored
        # rounding of the ends and of powers that cancel; the quadrature is as good on a short path
        for t in (0.0, span):
            size += span * (math.hypot(*at(t).force) * math.hypot(vx, vy) + abs(at(t).loss))
        assert at(span).stored - at(0.0).stored == pytest.approx(gain, abs=1e-9 * size)

    @for_any(units=some_units, x=lengths, y=lengths, vx=rates, vy=rates)
    def test_it_is_dimensionally_homogeneous(
        self, data: st.DataObject, units: Units, x: float, y: float, vx: float, vy: float
    ) -> None:
        assume(math.hypot(x, y) > 0.1)
        here = data.draw(self.elements)
        there, speed = rescaled(here, units), units.of("m/s", here)
        first = here.effect(Ends((x, y), (vx, vy), (0.0, 0.0)))
        ends = Ends((x * units.m, y * units.m), (vx * speed, vy * speed), (0.0, 0.0))
        second = there.effect(ends)
        size = 1e-9 + sum(map(abs, first.force)) + abs(first.loss) + first.stored
        for a, b, unit in (
            *((*pair, "N") for pair in zip(first.force, second.force, strict=True)),
            (first.stored, second.stored, "J"),
            *((getattr(first, n), getattr(second, n), "N m") for n in ("moment", "couple")),
            (first.loss, second.loss, "N m/s"),
            *((first.channels[n], second.channels[n], u) for n, u, _ in here.channels),
        ):
            factor = units.of(unit, here)
            assert b == pytest.approx(a * factor, rel=1e-9, abs=1e-9 * size * factor)

    @for_any()
    def test_it_gives_the_channels_that_it_announces(self, data: st.DataObject) -> None:
        effect = data.draw(self.elements).effect(Ends((1.0, 0.5), (0.1, 0.2), (0.0, 0.0)))
        assert list(effect.channels) == [name for name, _, _ in self.model.channels]

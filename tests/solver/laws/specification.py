"""What every contact law and every friction law must do, whichever it is.

A family's specification is a class: a law passes it by a subclass that draws the law.
"""

import inspect
import math
import re
from collections.abc import Callable, Sequence
from typing import Any, ClassVar, NamedTuple, TypeVar

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from jointplay.solver.laws.contact import ContactLaw
from jointplay.solver.laws.force import Effect, Ends, ForceElement
from jointplay.solver.laws.friction import FrictionLaw
from jointplay.solver.quantities.units import Strict

ROUNDING = 1e-13
"""A law is about ten operations, and a power of a large ratio amplifies a rounding tenfold."""


class Fit(NamedTuple):
    bearing_radius: float = 0.01
    radial_clearance: float = 5e-4
    bearing_width: float = 0.015


class Units(NamedTuple):
    """Factors by which the numbers of lengths, masses and times grow."""

    m: float
    kg: float
    s: float

    def of(self, unit: str, law: Strict) -> float:
        """Return the factor of a unit such as N/m^n; a law's own exponent stands for n."""
        if unit.startswith("unit of"):  # of what another field chooses; here it is left alone
            return 1.0
        factor = 1.0
        for place, part in enumerate(unit.split("/")):
            for symbol in part.split():
                name, _, power = symbol.partition("^")
                exponent = getattr(law, "exponent", 0.0) if power == "n" else float(power or 1)
                factor *= self._base(name) ** (exponent if place == 0 else -exponent)
        return factor

    def _base(self, name: str) -> float:
        newton = self.kg * self.m / self.s**2
        return {
            "1": 1.0,
            "rad": 1.0,
            "N": newton,
            "Pa": newton / self.m**2,
            "J": newton * self.m,
        }.get(name) or float(getattr(self, name))


some_units = st.builds(Units, *[st.floats(0.01, 100.0)] * 3)
Law = TypeVar("Law", bound=Strict)


def rescaled(law: Law, units: Units) -> Law:
    """Return a law with the numbers that its parameters have in other units."""
    fields = type(law).model_fields
    values: dict[str, Any] = {}
    for name, field in fields.items():
        extra = field.json_schema_extra
        unit = extra.get("unit", "1") if isinstance(extra, dict) else "1"
        value = getattr(law, name)
        if isinstance(value, Strict):
            values[name] = rescaled(value, units)
        else:
            values[name] = value * units.of(str(unit), law) if isinstance(value, float) else value
    return type(law).model_construct(**values)


def documented(model: type[Strict]) -> None:
    text = inspect.getdoc(model) or ""
    assert re.search(r"Source: .*\b(19|20)\d\d\b", text, re.DOTALL)
    assert "Assumes" in text
    assert "Fails" in text


def for_any(**strategies: st.SearchStrategy[Any]) -> Callable[[Any], Any]:
    """Draw a law and more; several laws share a specification, and no database of examples."""
    shared = settings(suppress_health_check=[HealthCheck.differing_executors], database=None)
    return lambda test: shared(given(data=st.data(), **strategies)(test))


depths = st.floats(1e-9, 1e-3)
rates = st.floats(-2.0, 2.0)
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

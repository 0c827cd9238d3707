"""Periodic orbits as points of a curve: Newton's method on the section map, and tangents.

An orbit is a vector (size + 1,): the section's state, then the parameter, both scaled; of special
orbits followed over a second parameter, that comes last. Lengths and angles along the branch are
those of states and parameters; latched impact rates do not count.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import count

import numpy as np
from numpy.linalg import LinAlgError

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.criticality import Surroundings, cubic_coefficient
from jointplay.solver.continuation.multipliers import (
    Complexes,
    largest,
    multipliers_of,
    spread,
)
from jointplay.solver.continuation.passage import Linear, Section
from jointplay.solver.continuation.section_map import COARSER, SectionMap
from jointplay.solver.continuation.special_map import FINE, GRAZING, SpecialMap
from jointplay.solver.linear_algebra.elimination import solve

AnyMap = SectionMap | SpecialMap
MOST_ROUNDS = 8
"""Rounds of Newton's method after which it ends unless it is close enough: then a few follow."""
CLOSE = 10.0
"""Residual at which Newton's method ends, in the tolerance of the runs."""
CLOSE_ENOUGH = 1e-6
"""Residual that is taken where another round makes it no smaller: rounding of hard contacts."""
FARTHEST = 1.0
"""Ranges by which Newton's method may move the parameter: runs farther away may not end."""
OPEN = 1e-5
"""Distance by which closing loops may move an orbit's section, rad or m: of one it is rounding."""
GAIN = 0.5
ASIDE = 3.0
"""Distance from grazing at which Newton's method begins, in squares of the step."""
FINER = (1.0, 0.03, 0.001)
"""Scales of differences that are tried: next to grazing the map bends within a micrometre."""
SHARP = 1e-3
"""Error of the multipliers, in the largest, above which a finer scale may be tried."""
BAR = 3.0
"""Share of the multipliers' bar in how far differences at two scales are apart: once that is too
little for 2 of 200 random orbits, by a factor of 1.4 at most (`benchmarks random_orbits`)."""
NEUTRAL = 1e-5
"""Distance from the unit circle, at most, that is one of multipliers on it if their bar is not
less: motion without losses has pairs that stay there."""
LOOSER = 10.0
"""The second tolerance of runs, in the first. Of 48 orbits with and without impacts, at tolerances
from 1e-7 to 5e-11, differences at two scales alone err by more than their share of the bar for 23,
by a factor of up to 190; the whole bar is too little for 4, by a factor of 1.9 at most."""


@dataclass(frozen=True)
class Scales:
    """Units of a curve; see `solver.continuation.start`."""

    extents: Floats
    """(size + 1,) what counts as one in each state, and in the parameter."""
    metric: Floats
    """(size + 1,) weights of squares in lengths along the branch."""

    def length(self, vector: Floats) -> float:
        """Return the length of a scaled vector."""
        return math.sqrt(self.product(vector, vector))

    def product(self, one: Floats, other: Floats) -> float:
        """Return the inner product of scaled vectors."""
        return float(np.sum(self.metric * one * other))


@dataclass(frozen=True)
class NoOrbit:
    """Newton's method has found none: why, and how near it came."""

    reason: str
    residual: float
    grazing: bool = False
    """Whether runs beside the last section have another number of impacts."""


@dataclass(frozen=True, eq=False)
class Orbit:
    """A periodic orbit."""

    curve: "Curve"
    vector: Floats
    linear: Linear
    residual: float
    """Distance of section and return, in the scales of the states."""
    rounds: int
    """Rounds of Newton's method."""
    scale: float = 1.0
    """Scale of the differences."""

    @property
    def section(self) -> Section:
        """Section of the orbit."""
        return self.curve.section(self.vector)

    @property
    def value(self) -> float:
        """Value of the parameter."""
        return self.section.value

    @property
    def values(self) -> tuple[float, ...]:
        """Values of the parameters that vary."""
        return self.section.values

    @property
    def onsets(self) -> int:
        """Impacts in a period."""
        return self.linear.passage.onsets

    @cached_property
    def multipliers(self) -> Complexes:
        """Multipliers, (size,)."""
        return multipliers_of(self.linear.monodromy)

    @cached_property
    def coarser(self) -> Linear:
        """The map here by differences at the other scale."""
        return self.curve.map.linear(self.section, COARSER * self.scale)

    @cached_property
    def error(self) -> float:
        """Distance of the multipliers by differences at two scales."""
        return spread(self.multipliers, multipliers_of(self.coarser.monodromy))

    @cached_property
    def looser(self) -> Linear:
        """The map here by runs at the looser tolerance, at the scale of the orbit's differences.

        They tell the orbit's margins and phases of friction, too.
        """
        map_ = self.curve.sections
        fine = FINE if self.curve.of == GRAZING else 1.0
        again = replace(map_, tolerance=LOOSER * map_.tolerance, watches=False, tells=True)
        (found,) = again.linears([self.section], fine * self.scale, over=0)
        return found

    @cached_property
    def bar(self) -> float:
        """Bar of the multipliers: by differences at two scales, and by runs at two tolerances.

        The finer differences may err on the side of the coarser ones, by more than they are apart.
        """
        if self.looser.passage.failure:
            return math.inf
        apart = spread(self.multipliers, multipliers_of(self.looser.monodromy))
        return BAR * self.error + apart

    @property
    def slack(self) -> float:
        """Distance from the unit circle within which multipliers may be on either side of it."""
        return min(self.bar, NEUTRAL)

    @cached_property
    def criticality(self) -> tuple[float, float]:
        """Cubic coefficient of a period doubling, and its error; see `cubic_coefficient`.

        Positive if orbits of twice the period are born stable.
        """
        map_ = self.curve.sections
        extents = self.curve.scales.extents[: map_.size]
        return cubic_coefficient(Surroundings(map_, self.section, self.linear, extents))

    @property
    def phases(self) -> tuple[int, ...]:
        """Number of times that each slip sticks and slides, in turn; none if a run failed."""
        if not self.curve.sections.has_friction or self.looser.passage.failure:
            return ()
        return self.looser.passage.phases

    @cached_property
    def sure(self) -> bool:
        """Whether the multipliers are known well, or no matter: all stay inside the circle."""
        most = largest(self.multipliers)
        return self.error <= SHARP * max(1.0, most) or most + self.error < 1.0

    def tangent(self, along: Floats, linear: Linear | None = None) -> Floats | None:
        """Return the branch's direction, of length 1, on the side of `along`; None: it has none."""
        matrix = self.curve.bordered(linear or self.linear, along)
        right = np.zeros(len(matrix))
        right[-1] = 1.0
        try:
            found = solve(matrix, right)
        except LinAlgError:
            return None
        return found / self.curve.scales.length(found)

    def guess(self, ahead: Floats, along: Floats) -> Floats:
        """Return the orbit that is predicted ahead; of grazing ones on the side without the impact.

        By the square of the step, which is what the prediction may err by.
        """
        if self.curve.of != GRAZING:
            return ahead
        right, step = np.zeros(len(ahead)), self.curve.scales.length(ahead - self.vector)
        right[-2] = -1.0
        aside = solve(self.curve.bordered(self.linear, along), right)
        return np.asarray(ahead + ASIDE * step * step / self.curve.scales.length(aside) * aside)


Way = tuple[Orbit, Floats]
"""An orbit, and the direction in which a branch goes on from there, as a scaled vector."""


@dataclass(frozen=True, eq=False)
class Curve:
    """The curve of fixed points of a section map."""

    map: AnyMap
    scales: Scales

    @property
    def sections(self) -> SectionMap:
        """The map of sections, without a test function."""
        return self.map.base if isinstance(self.map, SpecialMap) else self.map

    @property
    def of(self) -> str:
        """Label of the special orbits that the curve is of; empty: it is of any."""
        return self.map.label if isinstance(self.map, SpecialMap) else ""

    @property
    def parameters(self) -> int:
        """Number of parameters that vary along the curve: the last numbers of its vectors."""
        return 2 if self.of else 1

    def section(self, vector: Floats) -> Section:
        """Return the section of a scaled vector."""
        return self.map.section(vector * self.scales.extents)

    def vector(self, section: Section) -> Floats:
        """Return the scaled vector of a section."""
        return self.map.numbers(section) / self.scales.extents

    def bordered(self, linear: Linear, along: Floats) -> Floats:
        """Return (size + 1, size + 1) derivative of the residual; last the condition `along`."""
        size = self.map.size
        extents = self.scales.extents
        matrix = np.zeros((size + 1, size + 1))
        matrix[:size, :size] = linear.jacobian - np.eye(size)
        matrix[:size, size:] = linear.sensitivity
        matrix[:size] *= extents / extents[:size, None]
        matrix[size] = self.scales.metric * along
        return matrix

    def orbit(self, guess: Floats, along: Floats, begin: float = 1.0) -> Orbit | NoOrbit:
        """Return the orbit in the plane through a guess that is normal to a direction.

        `begin` : scale of the differences that is tried first, such as that of an orbit beside.
        """
        best: Orbit | NoOrbit | None = None
        scales = (1.0,) if self.of == GRAZING else FINER
        for scale in sorted(scales, key=lambda one: (one > begin, -one)):
            found = self._newton(guess, along, scale)
            if isinstance(found, Orbit):
                if found.sure:
                    return found
                if not isinstance(best, Orbit) or found.error < best.error:
                    best = found
            elif best is None or (isinstance(best, NoOrbit) and found.grazing):
                best = found
            if isinstance(found, NoOrbit) and not found.grazing and scale == max(FINER):
                break
        assert best is not None  # noqa: S101  (there are scales)
        return best

    def _newton(self, guess: Floats, along: Floats, scale: float) -> Orbit | NoOrbit:
        vector, before = guess.copy(), math.inf
        for rounds in count():
            linear = self.map.linear(self.section(vector), scale)
            if linear.passage.failure:
                return NoOrbit(linear.passage.failure, before)
            residual = self.map.distance(linear)
            stalled = residual > GAIN * before and rounds > 1
            if residual <= CLOSE * self.map.tolerance or (stalled and residual <= CLOSE_ENOUGH):
                if linear.passage.moved > OPEN:
                    return NoOrbit("a wheel behind gears is not back with the drive", residual)
                return Orbit(self, vector, linear, residual, rounds, scale)
            late = rounds >= MOST_ROUNDS and residual > CLOSE_ENOUGH
            if late or not math.isfinite(residual) or (stalled and rounds > 3):
                break
            before = residual
            right = np.append(-linear.residual / self.scales.extents[:-1], 0.0)
            right[-1] = self.scales.product(along, guess - vector)
            try:
                vector = vector + solve(self.bordered(linear, along), right)
            except LinAlgError:
                return NoOrbit("the derivative of the section map is singular", residual)
            if not np.abs(vector - guess)[-self.parameters :].max() <= FARTHEST:
                return NoOrbit("Newton's method went astray", residual)
            rates = vector[self.map.kernel.states : -self.parameters]
            rates[rates < 0.0] = 0.0
        sentence = f"Newton's method ended after {rounds} rounds with the residual {residual:.2g}"
        return NoOrbit(sentence, residual, grazing=not linear.alike)

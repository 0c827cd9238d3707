"""Past grazing at a hard stop: the orbit with one impact more, or one less.

Where a stop gives way by less than differences are, the section map has a corner at grazing. With P
the map without the impact, it is P(x, p) + J v behind it: v is the speed of the impact, J what that
displaces, and v^2 is in proportion to the depth at which the motion would be without the stop
(Nordmark 1991, Journal of Sound and Vibration 145:279). Newton's method in (x, p) fails at that
root; with the speed as the unknown all is smooth (Ghosh and Simpson 2025, arXiv 2510.16218). Orbits
with the impact leave grazing where (1 - DP) dx - P_p dp = J v, to first order at no depth.
"""

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np
from numpy.linalg import LinAlgError

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.orbit import Curve, NoOrbit, Orbit, Scales, Way
from jointplay.solver.continuation.passage import Passage
from jointplay.solver.continuation.special_map import FINE, GRAZING, SpecialMap
from jointplay.solver.linear_algebra.elimination import solve

DEPTHS = (1e-5, 1e-4, 1e-3)
"""Depths of the impacts that are tried, in how far the pair moves; the first is the slowest."""
DISTANCES = (1e-3, 1e-4, 1e-2)
"""Distances from grazing, along the branch, of the orbits without the impact that are tried."""
ASIDE = (1e-7, 1e-6, 1e-5, 1e-4, 1e-3)
"""Distances from an orbit at which runs with another number of impacts are sought."""
NEAR = 1e-2
"""Distance from an orbit within which grazing is what it was lost at."""
MOST_ROUNDS = 12
SETTLED = 1e-3
"""Change of an orbit, in its distance from grazing, at which its impact has the wanted speed."""
ASTRAY = 0.2
"""Share of that distance by which Newton's method may move it then."""
OTHERS = "another impact begins or ends, too"


@dataclass(frozen=True)
class Passed:
    """Where a branch goes on behind grazing."""

    grazing: Orbit
    """Next to grazing, on the side without the impact."""
    bound: float
    """Error of its parameter as that of grazing, at most."""
    note: str
    way: Way


@dataclass(frozen=True)
class Grazing:
    """An orbit next to grazing, on the side without the impact."""

    plain: Curve
    """The curve of any orbits."""
    special: Orbit
    """The orbit on the curve over a second parameter, on which nothing depends."""
    onsets: int
    """Impacts in a period without the one that begins."""

    @property
    def vector(self) -> Floats:
        """The orbit, (size + 1,), scaled."""
        return self.special.vector[:-1]

    @property
    def gap(self) -> float:
        """Distance from the impact, in how far the pair moves: about `special_map.MARGIN`."""
        return -self.special.linear.passage.nearest

    def moved(self, nearer: float, away: Floats | float = 0.0) -> Floats:
        """Return how the orbit moves, to first order and without the impact.

        `nearer` : to the impact, in how far the pair moves. away : (size + 1,) by which sections
        are to come back elsewhere, scaled; the last number does not count.
        """
        size = len(self.vector)
        matrix = self.special.curve.bordered(self.special.linear, np.zeros(size + 1))
        side = np.full(size, away)
        side[-1] = nearer / self.plain.scales.extents[-1]
        return solve(matrix[:-1, :-1], side)

    def run(self, vector: Floats) -> tuple[Passage, Floats]:
        """Return the run from a section, and (size + 1,) how far it ends from there, and a 0."""
        map_, section = replace(self.plain.sections, watches=True), self.plain.section(vector)
        (passage,) = map_.passages([section])
        return passage, np.append(
            map_.away(passage.end, section.state), 0.0
        ) / self.plain.scales.extents


def past_grazing(before: Orbit, last: Orbit) -> Passed | NoOrbit:
    """Return where a branch goes on that was lost next to grazing; else why not, as clauses.

    `before` : an orbit before, with another number of impacts if grazing was located. `last` :
    where the branch was lost.
    """
    tried = ""
    known = before.onsets != last.onsets
    if before.curve.sections.kernel.pairs and not before.curve.of:
        for gains in [last.onsets > before.onsets] if known else [True, False]:
            grazing = _grazing_beside(last, before.onsets - (not gains))
            if grazing is None:
                continue
            seek, places = (_with_impact, DEPTHS) if gains else (_without_impact, DISTANCES)
            reason = "the derivative of the section map is singular"
            with suppress(LinAlgError):
                for place in places:
                    way = seek(grazing, place)
                    if not isinstance(way, NoOrbit):
                        return _passed(before, grazing, way)
                    reason = way.reason
            tried += f"; behind grazing at {grazing.special.value:.9g} an orbit with one impact"
            tried += f" {'more' if gains else 'less'} was sought, but {reason}"
    return NoOrbit(tried, last.residual, grazing=bool(tried))


def _passed(before: Orbit, grazing: Grazing, way: Way) -> Passed:
    curve, (orbit, along) = grazing.plain, way
    linear = curve.map.linear(curve.section(grazing.vector), FINE)
    touch = Orbit(curve, grazing.vector, linear, curve.map.distance(linear), 0, FINE)
    onwards = grazing.moved(grazing.gap)
    bound = abs(float(onwards[-1] * curve.scales.extents[-1]))
    begins = orbit.onsets > before.onsets
    note = f"an impact {'begins' if begins else 'ends'}: {before.onsets} before, {orbit.onsets}"
    note += " behind; the stop is so hard that the branch has a corner"
    came = onwards if begins else grazing.vector + onwards - before.vector
    if along[-1] * came[-1] < 0.0:
        note += ", where it turns back"
    return Passed(touch, bound, note, way)


def _grazing_beside(orbit: Orbit, onsets: int) -> Grazing | None:
    """Return the grazing next to an orbit, on the side with so many impacts."""
    curve, one = orbit.curve, np.ones(1)
    base = curve.sections
    map_ = replace(base, scene_at=lambda value, _: base.scene_at(value), watches=True)
    extents = np.append(curve.scales.extents, one)
    scales = Scales(extents, np.append(curve.scales.metric, one))
    special = Curve(SpecialMap(map_, GRAZING, extents, onsets), scales)
    axis = np.append(0.0 * orbit.vector, one)
    for vector in _beside(orbit, onsets):
        found = special.orbit(np.append(vector, 0.0), axis)
        if isinstance(found, Orbit):
            near = curve.scales.length(found.vector[:-1] - orbit.vector) < NEAR
            return Grazing(curve, found, onsets) if near else None
    return None


def _beside(orbit: Orbit, onsets: int) -> Iterator[Floats]:
    """Yield vectors next to an orbit whose runs have so many impacts, the nearest first."""
    curve, states = orbit.curve, orbit.curve.sections.kernel.states
    for distance in ASIDE:
        steps = distance * np.eye(len(orbit.vector))[[*range(states), -1]]
        moved = [orbit.vector + sign * step for step in steps for sign in (1.0, -1.0)]
        runs = curve.sections.passages([curve.section(one) for one in moved])
        found = zip(moved, runs, strict=True)
        yield from [one for one, run in found if not run.failure and run.onsets == onsets][:1]


def _with_impact(grazing: Grazing, depth: float) -> Way | NoOrbit:
    """Return an orbit with the impact that begins at grazing, and the direction from there.

    The impact is as fast as that of the motion without it that comes so deep. What that displaces
    gives a first guess, which simplified Newton's method makes better.
    """
    curve, length = grazing.plain, grazing.plain.scales.length
    run, kick = grazing.run(grazing.vector + grazing.moved(depth))
    if run.failure or run.onsets != grazing.onsets + 1:
        return NoOrbit(run.failure or OTHERS, np.nan)
    speed, along = run.margins.speed, grazing.moved(0.0, -kick)
    vector = grazing.vector + along
    for _ in range(MOST_ROUNDS):
        run, away = grazing.run(vector)
        if run.failure or run.onsets - grazing.onsets not in (0, 1):
            return NoOrbit(run.failure or OTHERS, np.nan)
        share, deep = 0.0, run.nearest + grazing.gap
        if run.onsets > grazing.onsets:
            share = run.margins.speed / speed
            deep = grazing.gap + share * share * (depth - grazing.gap)
        change = grazing.moved(depth - deep, -away - (1.0 - share) * kick)
        if not np.isfinite(change).all():
            return NoOrbit("another contact is nearer", np.nan)
        vector = vector + change
        if length(change) < SETTLED * length(along):
            break
    found = curve.orbit(vector, along)
    if isinstance(found, NoOrbit):
        return found
    near = length(found.vector - vector) < ASTRAY * length(along)
    if not (near and found.sure and found.onsets == grazing.onsets + 1):
        return NoOrbit("Newton's method went astray", found.residual)
    return found, along


def _without_impact(grazing: Grazing, distance: float) -> Way | NoOrbit:
    """Return the orbit without the impact at a distance from grazing, and the direction there."""
    along = grazing.moved(-grazing.gap)
    along = along / grazing.plain.scales.length(along)
    found = grazing.plain.orbit(grazing.vector + distance * along, along)
    if isinstance(found, NoOrbit):
        return found
    return (found, along) if found.onsets == grazing.onsets else NoOrbit(OTHERS, found.residual)

"""Orbits at which branches begin: the one next to a motion, or several that the motion passes."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import chain

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.cyclic import with_cyclic
from jointplay.solver.continuation.orbit import Curve, NoOrbit, Orbit
from jointplay.solver.continuation.passage import Section
from jointplay.solver.continuation.plan import SECTIONS, TRIES
from jointplay.solver.continuation.section_map import SectionMap
from jointplay.solver.continuation.settled import NoStart, Settled, settle
from jointplay.solver.continuation.start import (
    first_orbit,
    isolated,
    repeated,
    scaled,
    shorter_period,
    within_a_turn,
)

DIFFERENT = 1e-4
"""Distance of sections, in the extents of the motion, beyond which orbits are different ones."""


def first_orbits(
    map_: SectionMap, value: float, state: Floats | None, periods: int, count: int
) -> list[Orbit | NoStart]:
    """Return (count,) orbits at a value of the parameter, or why there are not so many.

    One is that next to the section which the motion reaches after some periods, from the scene's
    start or a given state. Several are sought in the motion behind it.
    """
    try:
        settled = _settled(map_, value, state, periods)
        section = Section(value, settled.state)
        curve = scaled(map_, value, settled)
        curve = replace(curve, map=with_cyclic(curve.sections, section))
        if count == 1:
            return [first_orbit(curve, section)]
        return embedded_orbits(curve, section, count)
    except NoStart as none:
        return [none] * count


def _settled(map_: SectionMap, value: float, state: Floats | None, periods: int) -> Settled:
    """Return what `settle` does, at a section with wheels behind gears as at the start.

    NoStart: they are not back after the map's periods.
    """
    settled = settle(map_, value, state, periods)
    back_after = settled.back_after
    if map_.periods % back_after:
        raise NoStart(
            f"A wheel behind gears is back after {back_after} periods of the motion that was"
            f" reached, not after {map_.periods}; ask for 'period' {back_after}, or for one that is"
            " a multiple of it."
        )
    missing = -periods % back_after
    if missing and map_.crossing is None:
        settled = settle(map_, value, state, periods + missing)
    return settled


def embedded_orbits(curve: Curve, section: Section, count: int) -> list[Orbit | NoStart]:
    """Return (count,) different orbits next to the motion behind a section, or why there are fewer.

    Chaotic motion passes next to unstable orbits, and then nearly repeats.

    Raises
    ------
    NoStart
        Orbits are those of a family.
    """
    return _Search(curve, count).orbits(_sections(curve, section, SECTIONS))


def _sections(curve: Curve, section: Section, periods: int) -> list[Section]:
    """Return a section and those that follow, as far as the motion can be followed."""
    back_after = curve.sections.back_after
    once, sections = replace(curve.sections, periods=back_after), [section]
    for _ in range(periods // back_after):
        (passage,) = once.passages(sections[-1:])
        if passage.failure:
            break
        sections.append(replace(section, state=passage.end))
    return sections


@dataclass
class _Search:
    """Newton's method from sections that nearly come back, the closest returns first.

    Auerbach, Cvitanovic, Eckmann, Gunaratne and Procaccia 1987, Phys. Rev. Lett. 58:2387; Lathrop
    and Kostelich 1989, Phys. Rev. A 40:4028. Sections that are nearer to a known orbit than to
    their own return come last.
    """

    curve: Curve
    count: int
    """Orbits at most."""
    known: list[Floats] = field(default_factory=list)
    """States of sections of the orbits, and of those that repeat earlier."""

    def orbits(self, sections: Sequence[Section]) -> list[Orbit | NoStart]:
        """Return different orbits in the order of being found, filled up by why no other was."""
        found, tries, nearest = list[Orbit | NoStart](), 0, math.inf
        along = np.append(np.zeros(self.curve.map.size), 1.0)
        later = list[tuple[float, Section]]()
        for distance, section in chain(self._returns(sections), later):
            if tries == TRIES * self.count or len(found) == self.count:
                break
            if self._is_known(section, distance):
                later += [(0.0, section)] * (distance > 0.0)
                continue
            tries += 1
            orbit = self.curve.orbit(self.curve.vector(section), along)
            if isinstance(orbit, NoOrbit):
                nearest = min(nearest, orbit.residual)
            elif not self._is_known(orbit.section):
                found += self._taken(repeated(isolated(orbit)))
        missing = self.count - len(found)
        return found + [self._lack(len(found), len(sections), tries, nearest)] * missing

    def _lack(self, found: int, sections: int, tries: int, nearest: float) -> NoStart:
        """Return why no further orbit was found."""
        rest = f"; where it found none it came to the residual {nearest:.2g}"
        return NoStart(
            f"Orbits of period {self.curve.map.periods} that were found near {sections} sections of"
            f" the motion: {found}. Newton's method started from {tries} of them, the closest"
            f" returns first{rest if math.isfinite(nearest) else ''}. Ask for fewer 'orbits', or"
            " try another 'period', 'state' or number of periods to 'settle'."
        )

    def _returns(self, sections: Sequence[Section]) -> list[tuple[float, Section]]:
        """Return how far each section is from its return, with the section, the closest first."""
        map_ = self.curve.sections
        pairs = zip(sections, sections[map_.periods // map_.back_after :], strict=False)
        found = [(self._apart(one.state, other.state), one) for one, other in pairs]
        return sorted(found, key=lambda one: one[0])

    def _is_known(self, section: Section, distance: float = 0.0) -> bool:
        """Return whether a section is nearer than a distance to a known orbit, or on it."""
        within = max(distance, DIFFERENT)
        return any(self._apart(one, section.state) <= within for one in self.known)

    def _taken(self, orbit: Orbit) -> list[Orbit]:
        """Return a new orbit, unless it repeats after fewer periods; remember its sections."""
        around = _sections(self.curve, orbit.section, self.curve.sections.periods - 1)
        self.known += [one.state for one in around]
        try:
            return [] if shorter_period(orbit) else [within_a_turn(orbit)]
        except NoStart:
            return []

    def _apart(self, one: Floats, other: Floats) -> float:
        """Return how far states of sections are apart, in the extents of the motion."""
        map_ = self.curve.sections
        away = map_.away(one, other) / self.curve.scales.extents[:-1]
        return float(np.abs(away)[: map_.kernel.states].max())

"""Attractors that the points of a study end on: labels of points, and how often each is reached.

Motions that recur, or have come to rest, are told apart by the mean and the spread of their states
over a cycle of sections, which are the same wherever on the cycle a record ends. Others are told
apart where these differ beyond their own scatter (`scattered`). Over a parameter, attractors are
those of the value before that they are nearest to, also in a map with starts along its other axis.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from jointplay.records.arrays import Floats, Integers
from jointplay.records.cycles import SAME, Cycles, cycles_of
from jointplay.records.motion import (
    CHAOTIC,
    EQUILIBRIUM,
    MIXED,
    NAMES,
    PERIODS,
    QUASI_PERIODIC,
    WAITING,
    Labels,
    colour_of,
    motions,
    name_of,
)
from jointplay.records.scattered import MotionFeatures, clusters
from jointplay.records.share_error import error_of_starts
from jointplay.records.study import StudySource

CARRIED: Final = 0.2
"""Share of the range of all attractors: by less does one that recurs move from one value of a
parameter to the next."""
MOST: Final = 200
"""Attractors that have a label of their own; further ones share the next."""


@dataclass(frozen=True)
class Attractor:
    """One attractor, or a class of motions that are not told apart."""

    code: int
    """Label of its points."""
    name: str
    """Such as ``period-1 A``, ``chaotic`` or ``failed``."""
    points: int
    share: float
    """Part of the points that have ended."""
    error: float
    """Standard error of the share, see `error_of_starts`."""
    example: int
    """Index of the first point that ends on it."""


@dataclass(frozen=True)
class Attractors:
    """Labels of all points, (points,), and the attractors by code."""

    labels: Labels
    found: tuple[Attractor, ...]

    def name_of(self, code: int) -> str:
        """Return a label in words."""
        return next((one.name for one in self.found if one.code == code), name_of(code))


def colour_of_attractor(code: int) -> str:
    """Return the colour of a label, as #rrggbb: neighbours differ more than those of periods do."""
    turn, index = divmod(code - len(NAMES), len(PERIODS))
    if code < len(NAMES) or code == MIXED:
        return colour_of(code)
    return colour_of(len(NAMES) + turn * len(PERIODS) + 3 * index % len(PERIODS))


def attractors_of(source: StudySource) -> Attractors:
    """Return the attractors that are known of a study of the kind `basins`."""
    indicators = source.indicators
    period = indicators.get("period", np.full(source.points, np.nan))
    verdict = indicators.get("verdict", np.full(source.points, np.nan))
    motion = motions(source.status, verdict, period, source.verdict_names)
    cycles = cycles_of(source.attributes["states"], source.statistics, source.points)
    labels = np.minimum(motion, EQUILIBRIUM).astype(np.uint8)
    names = dict(enumerate(NAMES))
    chains: list[_Chain] = []
    ranges = cycles.of(motion >= QUASI_PERIODIC).ranges()
    for chosen in _by_value(source):
        found = list(_groups(motion[chosen], cycles.of(chosen)))
        if len([one for one in found if one.code == CHAOTIC]) > 1:
            names[CHAOTIC] = "chaotic (not told apart)"
        _carry_on(chains, found, chosen, cycles, ranges)
    alike = [chain.code for chain in chains]
    several = {code for code in alike if alike.count(code) > 1}
    shown = [one for one in chains if one.code >= EQUILIBRIUM or one.code in several]
    for index, chain in enumerate(shown):
        code = len(NAMES) + min(index, MOST)
        labels[np.concatenate(chain.members)] = code
        nth = [one.code for one in shown[:index]].count(chain.code)
        letter = f" {_letter(nth)}" if chain.code in several else ""
        names[code] = "others" if index >= MOST else name_of(chain.code) + letter
    return Attractors(labels, tuple(_table(labels, names, _starts(source))))


@dataclass
class _Group:
    """Points of one value that end on one attractor."""

    code: int
    """Label of their motion."""
    members: Integers
    features: Floats


@dataclass
class _Chain:
    """An attractor over the values of a parameter."""

    code: int
    members: list[Integers]
    features: Floats
    """At the last value where it was found."""


def parameter_of(source: StudySource) -> int | None:
    """Return the column of the parameter along which attractors are followed; None: there is none.

    Of a map it is the one axis on which more depends than the start; earlier versions did not keep
    which that is.
    """
    job = source.attributes["job"]
    if job["kind"] == "basin-stability":
        return 0 if job.get("along") else None
    beyond_start = source.attributes.get("beyond_start", ())
    return int(beyond_start[0]) if len(beyond_start) == 1 else None


def _by_value(source: StudySource) -> Iterator[Integers]:
    """Yield the points of each value of the parameter along which attractors are followed."""
    column = parameter_of(source)
    if column is None:
        yield np.arange(source.points)
        return
    order = np.argsort(source.values[:, column], kind="stable")
    values = source.values[order, column]
    yield from np.split(order, np.flatnonzero(np.diff(values)) + 1)


def _starts(source: StudySource) -> Integers:
    """Return (points,) the number of each point's start, of which all values have the same ones."""
    column = parameter_of(source)
    if column is None:
        return np.arange(source.points)
    others = np.delete(source.values, column, axis=1)
    return np.unique(others, axis=0, return_inverse=True)[1].reshape(-1)


def _groups(motion: Labels, cycles: Cycles) -> Iterator[_Group]:
    """Yield the attractors of points that differ in their starts alone."""
    closed = motion >= EQUILIBRIUM
    widths = np.maximum(cycles.scales, cycles.of(closed).ranges()) * SAME
    for code in np.unique(motion[closed]).tolist():
        left = np.flatnonzero(motion == code)
        for _ in range(MOST):
            if not len(left):
                break
            features = cycles.features[left[0]]
            near = (np.abs(cycles.apart(cycles.features[left], features)) <= widths).all(axis=1)
            yield _Group(code, left[near], features)
            left = left[~near]
        if len(left):  # of so many none has a label of its own
            yield _Group(code, left, cycles.features[left[0]])
    for code in (QUASI_PERIODIC, CHAOTIC):
        points = np.flatnonzero(motion == code)
        if len(points):
            own = cycles.of(points)
            for members in clusters(MotionFeatures(own.features, own.scatter(), own.angles)):
                yield _Group(code, points[members], own.features[members[0]])


def _carry_on(
    chains: list[_Chain], found: list[_Group], points: Integers, cycles: Cycles, ranges: Floats
) -> None:
    """Add the attractors of a value to the nearest of those before, one to one, or as new ones.

    ranges : (columns,) of all attractors.
    """
    near: list[tuple[float, int, int]] = []
    for code in {group.code for group in found} & {chain.code for chain in chains}:
        before = [c for c, chain in enumerate(chains) if chain.code == code]
        features = np.array([chains[c].features for c in before])
        most = CARRIED if code >= EQUILIBRIUM else np.inf
        for g, group in enumerate(found):
            if group.code == code:
                away = np.abs(cycles.apart(features, group.features) / ranges).max(axis=1).tolist()
                near += [(x, g, c) for x, c in zip(away, before, strict=True) if x <= most]
    taken: dict[int, int] = {}
    for _, g, c in sorted(near):
        if g not in taken and c not in taken.values():
            taken[g] = c
    for g, group in enumerate(found):
        members = points[group.members]
        if g in taken:
            chain = chains[taken[g]]
            chain.members.append(members)
            chain.features = group.features
        else:
            chains.append(_Chain(group.code, [members], group.features))


def _table(labels: Labels, names: Mapping[int, str], starts: Integers) -> list[Attractor]:
    codes, first, counts = np.unique(labels, return_index=True, return_counts=True)
    known = labels != WAITING
    ended, trials = int(known.sum()), np.bincount(starts[known])
    found = []
    for code, point, count in zip(codes.tolist(), first.tolist(), counts.tolist(), strict=True):
        if code != WAITING:
            own = np.bincount(starts[labels == code], minlength=len(trials))
            error = error_of_starts(own, trials)
            found.append(Attractor(code, names[code], count, count / ended, error, point))
    return found


def _letter(index: int) -> str:
    """Return A to Z, then AA and so on."""
    high, low = divmod(index, 26)
    return ("" if not high else _letter(high - 1)) + chr(ord("A") + low)

"""Attractors that the points of a study end on: labels of points, and how often each is reached.

Periodic motions are told apart by the mean and the spread of their states over a cycle of sections,
which are the same wherever on the cycle a record ends. Motions that do not recur are told apart by
their verdicts alone: two chaotic attractors of one mechanism count as one.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from jointplay.records.arrays import Flags, Floats, Integers
from jointplay.records.motion import (
    EQUILIBRIUM,
    MIXED,
    NAMES,
    PERIODS,
    WAITING,
    Labels,
    colour_of,
    motions,
    name_of,
)
from jointplay.records.study import StudySource

MEAN: Final = "cycle_mean."
SPREAD: Final = "cycle_spread."
"""Beginnings of names of statistics: of each state, its mean over a cycle and its spread."""
SAME: Final = 2e-3
"""Share of what counts as one in a state, or of the range of all attractors if that is more: closer
attractors are one. It is twice what sections may differ by that recur."""
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
    """Standard error of the share, binomial."""
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
    turn, place = divmod(code - len(NAMES), len(PERIODS))
    if code < len(NAMES) or code == MIXED:
        return colour_of(code)
    return colour_of(len(NAMES) + turn * len(PERIODS) + 3 * place % len(PERIODS))


def attractors_of(source: StudySource) -> Attractors:
    """Return the attractors that are known of a study of the kind `basins`."""
    indicators = source.indicators
    period = indicators.get("period", np.full(source.points, np.nan))
    verdict = indicators.get("verdict", np.full(source.points, np.nan))
    motion = motions(source.status, verdict, period, source.verdict_names)
    states: Mapping[str, Any] = source.attributes["states"]
    names = list(states["scales"])
    scales = np.array([states["scales"][name] for name in names])
    angles = np.array([name in states["angles"] for name in names])
    numbers = source.statistics
    missing = np.full(source.points, np.nan)
    means, spreads = (
        np.stack([numbers.get(f"{kind}{name}", missing) for name in names], axis=1)
        for kind in (MEAN, SPREAD)
    )
    places = np.concatenate([means, spreads], axis=1)
    return _labelled(motion, places, np.tile(scales, 2), np.concatenate([angles, 0 * angles > 0]))


def _labelled(motion: Labels, places: Floats, scales: Floats, angles: Flags) -> Attractors:
    """Return labels, given the motions of points and where in the states' space they end."""
    labels = np.minimum(motion, EQUILIBRIUM).astype(np.uint8)
    names = dict(enumerate(NAMES))
    closed = motion >= EQUILIBRIUM
    widths = np.maximum(scales, _ranges(places[closed], angles)) * SAME
    groups: list[tuple[str, Integers]] = []
    for code in np.unique(motion[closed]).tolist():
        left = np.flatnonzero(motion == code)
        while len(left):
            near = _near(places[left], places[left[0]], widths, angles)
            groups.append((name_of(code), left[near]))
            left = left[~near]
    alike = [name for name, _ in groups]
    for index, (name, members) in enumerate(groups):
        code = len(NAMES) + min(index, MOST)
        labels[members] = code
        letter = f" {_letter(alike[:index].count(name))}" if alike.count(name) > 1 else ""
        names[code] = "others" if index >= MOST else name + letter
    return Attractors(labels, tuple(_table(labels, names)))


def _table(labels: Labels, names: Mapping[int, str]) -> list[Attractor]:
    codes, first, counts = np.unique(labels, return_index=True, return_counts=True)
    ended = int(counts[codes != WAITING].sum())
    found = []
    for code, point, count in zip(codes.tolist(), first.tolist(), counts.tolist(), strict=True):
        if code != WAITING:
            share = count / ended
            error = math.sqrt(share * (1.0 - share) / ended)
            found.append(Attractor(code, names[code], count, share, error, point))
    return found


def _near(places: Floats, one: Floats, widths: Floats, angles: Flags) -> Flags:
    """Return which places are one of them, but for whole turns of angles."""
    apart = places - one
    apart -= 2.0 * np.pi * np.round(apart / (2.0 * np.pi)) * angles
    return np.asarray((np.abs(apart) <= widths).all(axis=1), np.bool_)


def _ranges(places: Floats, angles: Flags) -> Floats:
    """Return the range of each column, of angles at most a turn; nothing has the range 0."""
    if not len(places):
        return np.zeros(places.shape[1])
    found = np.ptp(places, axis=0)
    return np.asarray(np.where(angles, np.minimum(found, np.pi), found), np.float64)


def _letter(index: int) -> str:
    """Return A to Z, then AA and so on."""
    high, low = divmod(index, 26)
    return ("" if not high else _letter(high - 1)) + chr(ord("A") + low)

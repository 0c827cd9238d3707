"""Indicators of one point, from the states of the whole system at its sections."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.solver.nonlinear.batch_means import FEWEST_BATCHES
from jointplay.solver.nonlinear.decision import BY_CHANCE, CREEPS, WITHIN, decide
from jointplay.solver.nonlinear.estimate import UNKNOWN, Estimate
from jointplay.solver.nonlinear.lyapunov import (
    confirmed,
    exponent_from_growth,
    in_smaller_steps,
)
from jointplay.solver.nonlinear.recurrence import (
    creep_to_come,
    leaves_an_orbit,
    may_recur_by_chance,
    moves_within,
    recurrence_period,
)
from jointplay.solver.nonlinear.spectrum import flatness, power_spectrum, strongest_line
from jointplay.solver.nonlinear.verdict import Verdict
from jointplay.solver.nonlinear.whole_turns import unwound
from jointplay.solver.nonlinear.zero_one import zero_one_test
from jointplay.solver.runs.study.rotating_sections import (
    principal_plane,
    rotation_of,
    with_unit_vectors,
)
from jointplay.solver.scene.periods import InStep

RECURS = 1e-3
"""Sections closer than this share are the same: of what counts as one in a state, or of its range
in the record if that is more, as rates have that impacts make. Far above the solver's error."""
IN_STEP = InStep(back=True, others=0)
MOST_SECTIONS = 5000
"""That indicators look at: the first ones of the record."""
FEWEST_FOR_SPECTRUM, FEWEST_FOR_RECURRENCE = 16, 4
LATE = 0.1
"""Share of a period: growth is noted with the first step beyond its end, 0.01 of it at most."""


class Sections(NamedTuple):
    """States of the whole system at its sections, and what they are."""

    states: Floats
    """(sections, states) generalised coordinates, their speeds, inner states."""
    scales: Floats
    """(states,) what counts as one in each: the finest clearance, as length, turn, or rate of
    either."""
    angles: Flags
    """(states,) which are angles, whose whole turns do not count."""
    coordinates: int
    """Number of generalised coordinates."""
    interval: float
    """Mean time between them, s."""
    measured: bool = True
    """Whether a clearance, or a length that the scene gives, counts as one: what moves within a
    thousandth of that is noise. A link is no measure of how small a motion is."""


def indicators_of(
    chosen: Sequence[str],
    sections: Sections,
    log_growth: Floats,
    finer_growth: Floats,
    period: float,
    settled: int,
    *,
    compared: bool = False,
    drives: InStep = IN_STEP,
) -> tuple[dict[str, float], Verdict]:
    """Return the chosen indicators, each with its error, and the verdict that they allow.

    What too few sections do not give is NaN.

    chosen : of ``lyapunov``, ``zero_one``, ``recurrence``, ``rotation``, ``spectrum``. log_growth :
    (periods,) logarithm of the tangent vector's growth in each period of the record. finer_growth :
    the same behind the record, in far smaller steps. period : s. settled : periods of the vector
    before the record. compared : whether cycles are compared with those of other points: then one
    that still creeps does not recur, for it would be another attractor than that it comes to.
    drives : which are in step with sections; by default all are.
    """
    by_period = len(sections.states) == len(log_growth)
    states = unwound(sections.states[:MOST_SECTIONS], sections.angles) / sections.scales
    found: dict[str, float] = {}
    lyapunov = finer = zero_one = rotation = None
    seen = (
        _recurrence(states, compared=compared) if {"recurrence", "lyapunov"} & set(chosen) else None
    )
    recurrence = seen if "recurrence" in chosen else None
    if "lyapunov" in chosen:
        turns = recurrence if recurrence and by_period else 1
        lyapunov, finer = exponents(log_growth, finer_growth, period, settled, turns)
        stated = confirmed(lyapunov, finer)
        found |= {"lyapunov": stated.value, "lyapunov_error": stated.error}
    if "zero_one" in chosen:
        zero_one = UNKNOWN
        if len(states):
            whole = with_unit_vectors(states, sections.scales, sections.angles)
            zero_one = zero_one_test(whole, resolution=RECURS)
        found |= {"zero_one": zero_one.value, "zero_one_error": zero_one.error}
    if "recurrence" in chosen:
        found["period"] = _number(recurrence)
    if "rotation" in chosen:
        if len(states) > 2:
            rotation = rotation_of(states, sections.scales, sections.angles, sections.coordinates)
        found["rotation"] = rotation.value if rotation else math.nan
        found["rotation_error"] = rotation.error if rotation else math.nan
        rotation = rotation or UNKNOWN
    if "spectrum" in chosen:
        found |= _spectrum(states, sections)
    leaves = False
    if lyapunov is not None and lyapunov.exceeds(0.0):
        recurrence = seen  # neighbours of an unstable orbit part, too, whatever was asked for
        found["period"] = _number(seen)
        leaves = leaves_an_orbit(states)
    known = log_growth if by_period else None
    doubt = _doubt(states, recurrence, known, measured=sections.measured)
    evidence = lyapunov, zero_one, recurrence, rotation, finer
    verdict = decide(*evidence, drives=drives, leaves=leaves, doubt=doubt)
    return found | {"verdict": float(verdict.code)}, verdict


def _spectrum(states: Floats, sections: Sections) -> dict[str, float]:
    """Return what the spectrum of the sections says."""
    if len(states) < FEWEST_FOR_SPECTRUM:
        return dict.fromkeys(("line_frequency", "line_share", "flatness"), math.nan)
    along = principal_plane(states, sections.coordinates)[:, 0]
    spectrum = power_spectrum(along, sections.interval)
    frequency, share = strongest_line(spectrum)
    return {"line_frequency": frequency, "line_share": share, "flatness": flatness(spectrum)}


def _number(period: int | None) -> float:
    return math.nan if period is None else float(period)


def _doubt(states: Floats, period: int | None, log_growth: Floats | None, *, measured: bool) -> str:
    """Return why sections that recur may not do so for good, as `decide` takes it.

    log_growth : (periods,) as in `indicators_of`, of sections once a period; None: of others.
    """
    if not period:
        return ""
    whole = states / np.maximum(np.ptp(states, axis=0), 1.0)
    if len(states) >= 3 * period and creep_to_come(whole, period) > RECURS:
        return CREEPS
    growth = None
    if log_growth is not None and len(log_growth) and _known(log_growth):
        growth = float(_by_orbit(log_growth, period).sum())
    if may_recur_by_chance(whole, period, RECURS, growth):
        return BY_CHANCE
    return WITHIN if not measured and moves_within(states, RECURS) else ""


def _recurrence(states: Floats, *, compared: bool) -> int | None:
    """Return the period by recurrence, 0: there is none, None: too few sections to tell."""
    if len(states) < FEWEST_FOR_RECURRENCE:
        return None
    widths = np.maximum(np.ptp(states, axis=0), 1.0)
    period = recurrence_period(states, widths, RECURS)
    if compared and period and creep_to_come(states / widths, period) > RECURS:
        return 0
    return period


def exponents(
    log_growth: Floats, finer_growth: Floats, period: float, settled: int, turns: int = 1
) -> tuple[Estimate, Estimate]:
    """Return the exponent of a record and the one in far smaller steps, as `indicators_of` has it.

    Each has the error of its length alone; one about which nothing is known is UNKNOWN. Of a
    tangent that vanished the first is -inf with an infinite error: the motion may have a finite
    one.

    turns : periods after which the motion recurs. Growth comes and goes along an orbit, and is the
    same over each whole one; a record of eight orbits or more is taken by them.
    """
    if not len(log_growth) or not _known(log_growth):
        return UNKNOWN, UNKNOWN
    whole = turns if len(log_growth) >= FEWEST_BATCHES * turns else 1
    orbits, time = _by_orbit(log_growth, whole), whole * period
    record = exponent_from_growth(orbits, time, settled // whole)
    if record.value == -math.inf:  # below what a double holds, and then for good
        return replace(record, error=math.inf), UNKNOWN
    if not len(finer_growth) or not _known(finer_growth):
        return record, UNKNOWN
    if len(finer_growth) < whole:
        return record, in_smaller_steps(log_growth, finer_growth, period)
    return record, in_smaller_steps(orbits, _by_orbit(finer_growth, whole), time)


def _by_orbit(log_growth: Floats, turns: int) -> Floats:
    """Return the growth over each whole orbit, (orbits,), the last ones."""
    orbits = len(log_growth) // turns
    last = log_growth[len(log_growth) - orbits * turns :]
    return np.asarray(last.reshape(orbits, turns).sum(axis=1), np.float64)


def _known(log_growth: Floats) -> bool:
    return not (np.isnan(log_growth) | (log_growth == np.inf)).any()


def growth_by_period(rows: Floats, period: float, settled: int) -> Floats:
    """Return how much the tangent grew in each recorded period, (periods,) logarithms.

    rows : (k, 2) ends of the times in which it grew, s since the start, and logarithms. They end
    with the first step beyond a period and with the run, which may be in the midst of one: that
    one is left out.
    """
    turns = rows[:, 0] / period - settled
    index = np.round(turns).astype(np.int64) - 1
    whole = (index >= 0) & (np.abs(turns - (index + 1)) <= LATE)
    if not whole.any():
        return np.zeros(0)
    grown = np.zeros(int(index[whole].max()) + 1)
    np.add.at(grown, index[whole], rows[whole, 1])
    return grown
